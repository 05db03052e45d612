//! The forces on one sphere that no other sphere exerts.

use glam::DVec3;

use crate::forces::{self, Force, ForceEdge, SphereState};
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
    /// Edges of these forces.
    edges: Vec<ForceEdge>,
}

impl<'a> FreeField<'a> {
    /// The forces on the sphere with this index of the world's arrays.
    pub fn of(system: &System<'a>, index: usize) -> Self {
        let (radius, mass) = (system.spheres.radius[index], system.spheres.mass[index]);
        let (linear, _) = forces::total_linear(system.forces, radius, mass);
        let others = forces::without_linear_form(system.forces, radius, mass);
        let applied = system.spheres.applied_acceleration(index).unwrap_or(DVec3::ZERO);
        Self {
            uniform: linear.acceleration + applied,
            drag_rate: linear.drag_rate,
            radius,
            mass,
            edges: others.iter().flat_map(|force| force.edges(radius)).collect(),
            others,
        }
    }

    /// Time in which the sphere moves by its radius \[s\].
    pub fn time_of_a_radius(&self, velocity: DVec3, acceleration: DVec3) -> f64 {
        let by_speed = self.radius / velocity.norm();
        by_speed.min((2.0 * self.radius / acceleration.norm()).sqrt())
    }

    /// Removes the edges of the forces, for a step of any length.
    pub fn ignore_edges(&mut self) {
        self.edges.clear();
    }

    /// Planes at which the forces bend or jump.
    pub fn edges(&self) -> impl Iterator<Item = ForceEdge> {
        self.edges.iter().copied()
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
