//! Prefetching: data of the next events are fetched into the cache before they are needed.

use prefetch_index::prefetch_index;

use crate::rule::exact::events::UpcomingEvent;
use crate::rule::exact::timeline::Timeline;
use crate::system::System;

/// Fetches the data of the events at the head of the queue, where they are not in the fast caches.
#[inline]
pub(crate) fn upcoming_events(timeline: &Timeline, system: &System) {
    if !timeline.are_many() {
        return;
    }
    let Timeline { flights, neighbours, schedule, work, .. } = timeline;
    // Each stage of the prefetch uses the data that the stages before have fetched.
    let at_work = |place: usize| {
        let slot = schedule.upcoming(place);
        let next = slot.map(|slot| schedule.first(slot));
        let leaves = matches!(next, Some(UpcomingEvent::CellCrossing(_)));
        let other = match next {
            Some(UpcomingEvent::Event(event)) => event.target.slot(),
            _ => None,
        };
        slot.into_iter().chain(other).map(move |slot| (slot, leaves))
    };
    if let Some(slot) = schedule.upcoming(10) {
        schedule.prefetch(slot);
    }
    for (slot, _) in at_work(8) {
        prefetch_index(&flights.bodies, slot as usize);
        schedule.prefetch(slot);
        prefetch_index(&flights.index_of, slot as usize);
        work.prefetch(slot);
        neighbours.prefetch_place(slot);
    }
    for (slot, leaves) in at_work(5) {
        prefetch_index(&system.spheres.id, flights.index_of[slot as usize] as usize);
        neighbours.prefetch_cells(slot, leaves);
    }
    for (slot, leaves) in at_work(2) {
        neighbours.prefetch_near(slot, leaves, &flights.bodies);
    }
}
