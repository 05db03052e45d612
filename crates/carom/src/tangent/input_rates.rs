//! How linear forces on a sphere depend on its radius and its mass, and what that adds to its flight.

use glam::DVec3;

use super::state::SphereTangent;
use super::variation::Variation;
use crate::flight::{DragSlopes, Propagator};
use crate::forces::{self, LinearForce, SphereState};
use crate::id::SphereId;
use crate::system::System;

/// Derivatives of the linear forces on a sphere by its radius, and by its mass; NaN where they are not known.
#[derive(Debug, Clone, Copy)]
pub(super) struct InputRates {
    /// Rates of the acceleration by everything but drag.
    pub acceleration: [DVec3; 2],
    /// Rates of the drag rate.
    pub drag_rate: [f64; 2],
}

/// What changes of the radius and of the mass of a sphere add to its motion at the end of a flight.
#[derive(Debug, Clone)]
pub(super) struct InputChange {
    /// Index of the sphere in the arrays of the world.
    pub place: usize,
    pub id: SphereId,
    /// Derivatives of position and velocity by the radius, and by the mass.
    pub by: [[DVec3; 2]; 2],
}

impl InputRates {
    /// Returns the derivatives for a sphere; `None` if its forces depend on neither.
    pub fn of(system: &System, place: usize) -> Option<Self> {
        let applied = system.spheres.applied_acceleration(place);
        if system.forces.iter().len() == 0 && applied.is_none() {
            return None;
        }
        let (radius, mass) = (system.spheres.radius[place], system.spheres.mass[place]);
        let on = |radius, mass| forces::total_linear(system.forces, radius, mass).0;
        let here = on(radius, mass);
        if applied.is_none() && here == on(2.0 * radius, mass) && here == on(radius, 2.0 * mass) {
            return None;
        }
        let unknown = Self { acceleration: [DVec3::NAN; 2], drag_rate: [f64::NAN; 2] };
        // Of the force, by radius and by mass.
        let sum = |velocity: DVec3| {
            let state = SphereState { position: DVec3::ZERO, velocity, radius, mass };
            system.forces.iter().try_fold([DVec3::ZERO; 2], |sums, (_, force)| {
                let it = force.derivatives(&state, 0.0)?;
                Some([sums[0] + it.by_radius, sums[1] + it.by_mass])
            })
        };
        let (Some(at_rest), Some(moving)) = (sum(DVec3::ZERO), sum(DVec3::X)) else {
            return Some(unknown);
        };
        // The force is m a - m c v.
        let acceleration = here.acceleration + applied.unwrap_or_default();
        let by_mass = (at_rest[1] - acceleration) / mass;
        let drag_by_radius = (at_rest[0] - moving[0]).x / mass;
        let drag_by_mass = ((at_rest[1] - moving[1]).x - here.drag_rate) / mass;
        Some(Self {
            acceleration: [at_rest[0] / mass, by_mass],
            drag_rate: [drag_by_radius, drag_by_mass],
        })
    }

    /// Returns whether they are known.
    pub fn are_known(&self) -> bool {
        self.acceleration.iter().all(|it| it.is_finite())
            && self.drag_rate.iter().all(|it| it.is_finite())
    }

    /// Returns these rates without those of the acceleration; `None` if drag does not depend on the inputs.
    pub fn of_drag(&self) -> Option<Self> {
        let depends = self.drag_rate != [0.0; 2];
        depends.then_some(Self { acceleration: [DVec3::ZERO; 2], ..*self })
    }

    /// Returns the derivatives of position and velocity after a flight that began with a velocity \[m/s\] and lasted for
    /// a time \[s\].
    pub fn change(&self, linear: LinearForce, velocity: DVec3, time: f64) -> [[DVec3; 2]; 2] {
        let LinearForce { acceleration, drag_rate } = linear;
        let over = Propagator::over(time, drag_rate);
        let DragSlopes { decay, drift, fall } = DragSlopes::over(time, drag_rate);
        [0, 1].map(|input| {
            let (faster, drag) = (self.acceleration[input], self.drag_rate[input]);
            let way = over.fall * faster + drag * (drift * velocity + fall * acceleration);
            let gained = over.drift * faster + drag * (decay * velocity + drift * acceleration);
            [way, gained]
        })
    }
}

impl InputChange {
    /// Applies the derivative to the derivatives of the spheres in one direction.
    pub fn pass(&self, direction: &Variation, spheres: &mut [SphereTangent]) {
        let change = direction.sphere(self.id);
        for (amount, [position, velocity]) in [change.radius, change.mass].into_iter().zip(self.by)
        {
            if amount != 0.0 {
                spheres[self.place].position += amount * position;
                spheres[self.place].velocity += amount * velocity;
            }
        }
    }

    /// Adds the derivatives by radius and mass to a gradient, given those by the motion at the end of the flight.
    pub fn pass_back(&self, spheres: &[SphereTangent], gradient: &mut Variation) {
        let after = spheres[self.place];
        let [radius, mass] = self.by.map(|[position, velocity]| {
            position.dot(after.position) + velocity.dot(after.velocity)
        });
        let sphere = gradient.sphere_mut(self.id);
        sphere.radius += radius;
        sphere.mass += mass;
    }
}
