//! Changes: what an event changed about a sphere, for other copies of the timeline.

use crate::rule::exact::events::Prediction;
use crate::rule::exact::flights::{Body, Rotation};
use crate::rule::exact::neighbours::Region;
use crate::rule::exact::timeline::Timeline;

/// When a sphere had its last event in a segment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stamp {
    /// The number of the phase; 0 before the first.
    pub phase: u32,
    /// Time on the world's clock \[s\].
    pub time: f64,
}

impl Stamp {
    /// No event.
    pub const NONE: Self = Self { phase: 0, time: f64::NEG_INFINITY };
}

/// The flight of a sphere and its next events after an event.
#[derive(Debug)]
pub(super) struct Change {
    pub slot: u32,
    pub stamp: Stamp,
    body: Body,
    rotation: Option<Rotation>,
    prediction: Prediction,
    pub region: Region,
}

impl Change {
    /// Reads the sphere at `slot`.
    pub fn of(timeline: &Timeline, slot: u32, stamp: Stamp) -> Self {
        let Timeline { flights, neighbours, schedule, .. } = timeline;
        let index = flights.index_of[slot as usize];
        Self {
            slot,
            stamp,
            body: flights.bodies[slot as usize],
            rotation: flights.rotations.get(index as usize).cloned(),
            prediction: schedule.prediction(slot),
            region: neighbours.region_of(slot),
        }
    }

    /// Writes it to another copy of the timeline.
    pub fn write_to(&self, timeline: &mut Timeline) {
        let Timeline { flights, neighbours, .. } = timeline;
        let index = flights.index_of[self.slot as usize];
        flights.bodies[self.slot as usize] = self.body;
        if let (Some(to), Some(from)) = (flights.rotations.get_mut(index as usize), &self.rotation)
        {
            to.clone_from(from);
        }
        let level = flights.species_of(self.slot).level;
        neighbours.set_region(self.slot, level, self.region);
        timeline.enter(self.slot, self.prediction);
    }
}
