//! Which spheres that are in no zone have neighbours in one.

use crate::rule::exact::neighbours::NeighbourBuffer;
use crate::rule::exact::timeline::Timeline;

/// Finds them all, where neighbours are others than before.
pub(crate) fn find_near(timeline: &mut Timeline) {
    let Timeline { flights, zone, neighbours, .. } = timeline;
    zone.near.clear();
    if zone.is_empty() {
        return;
    }
    let mut found = NeighbourBuffer::default();
    for slot in 0..flights.bodies.len() as u32 {
        if flights.is_stepped(slot) {
            continue;
        }
        neighbours.find(slot, flights.species_of(slot).level, &mut found);
        if found.others(slot).any(|other| flights.is_stepped(other.slot())) {
            zone.near.push(slot);
        }
    }
}
