//! A sphere of a group at the instant of an impact.

use glam::DVec3;

use crate::flight::Flight;
use crate::rule::exact::contacts::contact_scale::ContactScale;
use crate::rule::exact::flights::{Flights, Species};
use crate::system::System;

/// A sphere of a group.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Member {
    pub slot: u32,
    /// Index of the sphere in the arrays of the world.
    pub index: u32,
    /// Centre \[m\] and velocity \[m/s\] at the instant.
    pub position: DVec3,
    pub velocity: DVec3,
    /// Where friction acts \[rad/s\].
    pub angular_velocity: DVec3,
    /// The species without contact forces.
    pub species: Species,
}

impl Member {
    /// The sphere at `slot` at `time` \[s\], before any impulse.
    pub fn at(flights: &Flights, slot: u32, time: f64) -> Self {
        let (position, velocity) = flights.state_of(slot, time);
        Self {
            slot,
            index: flights.index_of[slot as usize],
            position,
            velocity,
            angular_velocity: flights.angular_velocity_of(slot, time),
            species: flights.free_species_at(slot, time),
        }
    }

    /// Updates the forces on a sphere whose velocity at `time` \[s\] differs from that of its curve.
    pub fn renew_forces(&mut self, flights: &Flights, system: &System, time: f64) {
        if !flights.are_curved() || !self.species.is_curved {
            return;
        }
        let acceleration = flights.acceleration_of(system, self.slot, self.state(), time);
        // Drag in closed form is no part of the acceleration of a species.
        self.species.acceleration = acceleration + self.species.drag_rate * self.velocity;
    }

    /// Centre \[m\] and velocity \[m/s\].
    pub fn state(&self) -> [DVec3; 2] {
        [self.position, self.velocity]
    }

    /// The energy that it has gained, at the same instant, since it was `before` \[J\]; `moment` is its moment of inertia
    /// \[kg m²\].
    pub fn gained_since(&self, before: &Self, moment: f64) -> f64 {
        let squares = |after: DVec3, before: DVec3| 0.5 * (after - before).dot(after + before);
        let moving = squares(self.velocity, before.velocity);
        let fallen = self.species.acceleration.dot(self.position - before.position);
        let turning = squares(self.angular_velocity, before.angular_velocity);
        self.species.mass * (moving - fallen) + moment * turning
    }

    /// The scale of the contacts of this sphere with surfaces; `is_curved` if one of them is.
    pub fn scale(&self, is_curved: bool) -> ContactScale {
        let scale = ContactScale { is_curved, ..ContactScale::default() };
        scale.with(self.position, self.velocity, &self.species)
    }

    /// The sphere after `h` \[s\] under this acceleration of everything but drag \[m/s²\].
    pub fn after(&self, acceleration: DVec3, h: f64) -> Self {
        let Self { position, velocity, species, .. } = *self;
        let flight = Flight { position, velocity, acceleration, drag_rate: species.drag_rate };
        let (position, velocity) = flight.after(h);
        Self { position, velocity, ..*self }
    }
}
