//! The forces on one sphere that no other sphere exerts.

use glam::DVec3;

use crate::forces::{self, Force, SphereState};
use crate::norm::Norm;
use crate::system::System;

/// The forces on one sphere.
pub(crate) struct FreeField<'a> {
    /// Constant acceleration \[m/s²\].
    uniform: DVec3,
    /// \[1/s\]
    drag_rate: f64,
    pub radius: f64,
    pub mass: f64,
    /// Forces that are not linear.
    others: Vec<&'a dyn Force>,
}

impl<'a> FreeField<'a> {
    /// The forces on the sphere with this index of the world's arrays.
    pub fn of(system: &System<'a>, index: usize) -> Self {
        let (radius, mass) = (system.spheres.radius[index], system.spheres.mass[index]);
        let (linear, _) = forces::total_linear(system.forces, radius, mass);
        let applied = system.spheres.applied_acceleration(index).unwrap_or(DVec3::ZERO);
        Self {
            uniform: linear.acceleration + applied,
            drag_rate: linear.drag_rate,
            radius,
            mass,
            others: forces::without_linear_form(system.forces, radius, mass),
        }
    }

    pub fn acceleration_and_size(
        &self,
        time: f64,
        position: DVec3,
        velocity: DVec3,
    ) -> (DVec3, f64) {
        let Self { uniform, drag_rate, radius, mass, .. } = *self;
        let state = SphereState { position, velocity, radius, mass };
        let start = (uniform - drag_rate * velocity, uniform.norm() + drag_rate * velocity.norm());
        self.others.iter().fold(start, |(sum, size), force| {
            let own = force.on(&state, time) / mass;
            (sum + own, size + own.norm())
        })
    }
}
