//! Spheres that are moved out of an overlap, and the potential energy that they gain by it.

use glam::DVec3;

use crate::forces::{self, SphereState};
use crate::rule::exact::timeline::Timeline;
use crate::system::System;

/// A sphere that is moved at an instant.
#[derive(Debug, Clone, Copy)]
pub(super) struct Displacement {
    /// Index of the sphere.
    pub index: u32,
    /// Where its centre was \[m\].
    pub from: DVec3,
    /// Where its centre is now \[m\].
    pub to: DVec3,
    /// \[m/s\]
    pub velocity: DVec3,
}

/// Returns the potential energy \[J\] that spheres gain as they are moved at `now` \[s\]. Flights lead to where they
/// were.
pub(super) fn energy_gained(
    timeline: &Timeline,
    system: &System,
    moved: &[Displacement],
    now: f64,
) -> f64 {
    let in_fields = moved.iter().map(|it| {
        let place = it.index as usize;
        let (radius, mass) = (system.spheres.radius[place], system.spheres.mass[place]);
        let [before, after] = [it.from, it.to].map(|position| {
            let state = SphereState { position, velocity: it.velocity, radius, mass };
            forces::conservative_potential(system.forces, &state, now)
        });
        after - before
    });
    let in_fields: f64 = in_fields.sum();
    if !system.has_interactions() || moved.is_empty() {
        return in_fields;
    }
    let slots = &timeline.flights.slot_of;
    let states = slots.iter().map(|&slot| timeline.flights.state_of(slot, now));
    let (mut positions, velocities): (Vec<DVec3>, Vec<DVec3>) = states.unzip();
    let mut between_when_at = |place: fn(&Displacement) -> DVec3| {
        moved.iter().for_each(|it| positions[it.index as usize] = place(it));
        system.conservative_potential_between([&positions, &velocities], now)
    };
    let (before, after) = (between_when_at(|it| it.from), between_when_at(|it| it.to));
    in_fields + after - before
}
