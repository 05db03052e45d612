//! The list of spheres outside zones with neighbours inside.

use crate::rule::exact::neighbours::NeighbourBuffer;
use crate::rule::exact::timeline::Timeline;

/// Rebuilds the list when the neighbours changed.
pub(crate) fn find_near(timeline: &mut Timeline) {
    timeline.zone.near.clear();
    if timeline.zone.is_empty() {
        return;
    }
    let mut found = NeighbourBuffer::default();
    for slot in 0..timeline.flights.bodies.len() as u32 {
        if timeline.flights.is_stepped(slot) {
            continue;
        }
        let level = timeline.flights.species_of(slot).level;
        timeline.neighbours.find(slot, level, &mut found);
        timeline.note_near_zone(slot, &found);
    }
}
