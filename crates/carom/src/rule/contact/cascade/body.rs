//! Spheres of an island.

use glam::DVec3;

use crate::rule::contact::slabs::landings::Landed;
use crate::rule::contact::slots::row::Row;
use crate::rule::contact::slots::{self, Slots};

/// A sphere of an island.
#[derive(Debug, Clone, Copy)]
pub struct Body {
    pub slot: u32,
    pub position: DVec3,
    pub radius: f64,
    pub velocity: DVec3,
    /// 1/m \[1/kg\], 0 for one that sleeps.
    pub inverse_mass: f64,
    /// Velocity of its surface by spin, r w \[m/s\].
    pub spin: DVec3,
    /// 1/(k m) \[1/kg\], 0 without friction.
    pub inverse_inertia: f64,
    pub acceleration: DVec3,
    pub drag_rate: f64,
    /// Velocity and spin at the start of the flight.
    pub start: [DVec3; 2],
    /// Centre at the start of the flight before \[m\].
    pub from: DVec3,
    /// Centre at the start of the sub-step \[m\].
    pub began: DVec3,
    /// Sums over the flights so far, as in [`Landed`].
    pub way: DVec3,
    pub against_drag: f64,
    /// Whether the sphere pressed on something in the flight before.
    pub bears: bool,
    pub met_surface: bool,
    /// Time since the start of the sub-step \[s\].
    pub elapsed: f64,
    /// Rate of the shear flow about the sphere \[1/s\].
    pub shear_rate: f64,
}

impl Body {
    /// The sphere in a slot at the start of the sub-step.
    pub fn of(slots: &Slots, slot: usize) -> Self {
        let [position, before] = [slots.position[slot], slots.before[slot]];
        let zero = Row::default();
        let spin = slots.spin.get(slot).copied().unwrap_or(zero);
        let spin_before = slots.spin_before.get(slot).copied().unwrap_or(zero);
        let acceleration = if slots.sleeps[slot] { zero } else { slots.acceleration[slot] };
        let start = [before.vector(), spin_before.vector()];
        Self {
            slot: slot as u32,
            position: position.vector(),
            radius: position.number(),
            velocity: start[0],
            inverse_mass: slots.velocity[slot].number(),
            spin: start[1],
            inverse_inertia: spin.number(),
            acceleration: acceleration.vector(),
            drag_rate: acceleration.number(),
            start,
            from: position.vector(),
            began: position.vector(),
            way: DVec3::ZERO,
            against_drag: 0.0,
            bears: slots.bears[slot],
            met_surface: false,
            elapsed: 0.0,
            shear_rate: slots.shear.map_or(0.0, |shear| shear.rate),
        }
    }

    /// Whether impulses move the sphere.
    pub fn is_awake(&self) -> bool {
        self.inverse_mass > 0.0
    }

    /// The highest speed beside the flow about the sphere of what it may meet \[m/s\].
    pub fn speed(&self) -> f64 {
        let flow = DVec3::new(self.shear_rate * self.position.y, 0.0, 0.0);
        (self.velocity - flow).length() + self.shear_rate.abs() * self.radius
    }

    /// Returns the velocity after a flight of `h` \[s\] without contacts.
    pub fn accelerated(&self, h: f64) -> DVec3 {
        let force = Row::new(self.acceleration, self.drag_rate);
        slots::accelerated(Row::new(self.start[0], 0.0), force, h)
    }

    /// Adds a completed flight of `h` \[s\] to the sums that the work of forces needs.
    pub fn add_way(&mut self, h: f64) {
        let mean = 0.5 * (self.start[0] + self.velocity);
        self.way += h * mean;
        self.elapsed += h;
        self.against_drag += h * self.accelerated(h).dot(mean);
    }

    /// State at the end of the sub-step.
    pub fn landed(&self) -> Landed {
        let Self { slot, position, velocity, spin, from, way, against_drag, bears, .. } = *self;
        let (path, met_surface) = (position - self.began, self.met_surface);
        Landed { slot, position, path, velocity, spin, from, way, against_drag, bears, met_surface }
    }

    /// Acceleration by forces alone; zero for a supported sphere.
    pub fn free_acceleration(&self) -> DVec3 {
        if self.bears { DVec3::ZERO } else { self.acceleration }
    }
}
