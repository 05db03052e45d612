//! Forces that are held constant over a frame.

use glam::DVec3;

use super::timeline::Timeline;
use crate::forces::{self, SphereState};
use crate::system::System;

/// Begins a new flight of every sphere at the start of a frame, or of a part of it, under the forces
/// that act on it in the middle: an error of the third order in its length, of the second over all
/// frames (the midpoint rule). Lasting contacts are found anew.
pub(super) fn renew(timeline: &mut Timeline, system: &System, [start, end]: [f64; 2]) {
    let half = 0.5 * (end - start);
    for slot in 0..timeline.bodies.len() as u32 {
        timeline.set_free(slot);
        let kind = *timeline.kind_of(slot);
        let (position, velocity) = timeline.state_of(slot, start);
        let state = |position, velocity| SphereState {
            position,
            velocity,
            radius: kind.radius,
            mass: kind.mass,
        };
        let linear = forces::total_linear(system.forces, kind.radius, kind.mass).0;
        let index = timeline.index_of[slot as usize] as usize;
        let applied = system.spheres.applied_acceleration(index).unwrap_or(DVec3::ZERO);
        let acceleration_in = |state: &SphereState, time: f64| {
            let others = forces::total_of_others(system.forces, state, time) / kind.mass;
            linear.acceleration + applied + others
        };
        timeline.begin_flight(slot, position, velocity, start);
        // In a periodic box the flight may begin at an image of that place.
        let (position, velocity) = timeline.state_of(slot, start);
        let before = acceleration_in(&state(position, velocity), start);
        timeline.set_acceleration(slot, before);
        let (position, velocity) = timeline.state_of(slot, start + half);
        let middle = acceleration_in(&state(position, velocity), start + half);
        timeline.set_acceleration(slot, middle);
    }
}
