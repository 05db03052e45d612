//! Rooms: where a sphere meets no surface, but those that hold it, whichever way it flies. While it
//! stays there, no surface has to be looked at.

use glam::DVec3;

use super::timeline::Timeline;
use crate::detect::surface_tree::{Bounds, bounds};
use crate::flight::Flight;
use crate::system::System;

/// Where the centre of a sphere may be and touch no surface at rest of its neighbourhood, but those
/// that hold it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Room(Bounds);

impl Room {
    /// Nowhere.
    pub const NONE: Self = Self(Bounds { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY });

    /// A large one about the place where the flight of a sphere begins.
    pub fn about(timeline: &Timeline, system: &System, slot: u32) -> Self {
        let center = timeline.bodies[slot as usize].position;
        let radius = timeline.kind_of(slot).radius;
        let mut room = Bounds { min: DVec3::NEG_INFINITY, max: DVec3::INFINITY };
        for (surface, shift) in timeline.surfaces_near(slot) {
            if timeline.is_held_by(slot, surface) {
                continue;
            }
            let bounds = bounds(&system.surfaces[surface as usize].form);
            let Some(closed) = bounds.map(|bounds| bounds.widened(radius)) else {
                return Self::NONE;
            };
            let (below, above) = (closed.min + shift - center, center - (closed.max + shift));
            let gaps = below.max(above);
            let axis = gaps.max_position();
            if gaps[axis] <= 0.0 {
                return Self::NONE;
            }
            // It is open on that side of the surface that is farthest from it.
            if below[axis] > above[axis] {
                room.max[axis] = room.max[axis].min(center[axis] + below[axis]);
            } else {
                room.min[axis] = room.min[axis].max(center[axis] - above[axis]);
            }
        }
        Self(room)
    }

    /// Whether a sphere stays in it for a `time` \[s\].
    #[inline]
    pub fn holds(&self, flight: &Flight, time: f64) -> bool {
        let (place, way) = (flight.position, flight.farthest(time));
        ((place - way).cmpgt(self.0.min) & (place + way).cmplt(self.0.max)).all()
    }
}
