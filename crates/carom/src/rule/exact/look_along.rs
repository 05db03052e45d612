//! Sensors look along the flights of all spheres, as these end.

use super::timeline::Timeline;
use super::watch::{Seen, Watch};
use crate::id::SphereId;
use crate::sensor::FlightSegment;
use crate::system::System;

/// Begins to watch all flights at `now` \[s\].
pub(crate) fn begin(timeline: &mut Timeline, mut watch: Watch, now: f64) {
    let slots = &timeline.flights.slot_of;
    watch.flights = slots.iter().map(|&slot| seen(timeline, slot, now)).collect();
    watch.begun.clear();
    timeline.watch = Some(Box::new(watch));
}

/// Looks along the flights that ended since the last look.
#[inline]
pub(super) fn follow(timeline: &mut Timeline, system: &System) {
    if timeline.watch.as_ref().is_some_and(|watch| !watch.begun.is_empty()) {
        look_along_ended(timeline, system);
    }
}

#[inline(never)]
fn look_along_ended(timeline: &mut Timeline, system: &System) {
    let Some(mut watch) = timeline.watch.take() else { return };
    let mut begun = std::mem::take(&mut watch.begun);
    for &slot in &begun {
        let index = timeline.flights.index_of[slot as usize] as usize;
        let body = &timeline.flights.bodies[slot as usize];
        if body.generation != watch.flights[index].generation {
            look_along(&mut watch, timeline, system, index, body.time);
            let from = watch.flights[index].from;
            watch.flights[index] = seen(timeline, slot, from);
        }
    }
    begun.clear();
    watch.begun = begun;
    timeline.watch = Some(watch);
}

/// Looks along all flights up to `now` \[s\], and ends the watch.
pub(crate) fn end(timeline: &mut Timeline, system: &System, now: f64) -> Option<Watch> {
    look_along_ended(timeline, system);
    let mut watch = *timeline.watch.take()?;
    for index in 0..watch.flights.len() {
        look_along(&mut watch, timeline, system, index, now);
    }
    Some(watch)
}

/// Looks along the flight of a sphere up to `to` \[s\].
fn look_along(watch: &mut Watch, timeline: &Timeline, system: &System, index: usize, to: f64) {
    let Seen { flight, curve, flight_start, from, .. } = watch.flights[index];
    let sphere: SphereId = system.spheres.id[index];
    let radius = timeline.flights.species_of(timeline.flights.slot_of[index]).radius;
    let to = to.max(from);
    let index_of = index as u32;
    let segment =
        FlightSegment { sphere, index: index_of, radius, flight, curve, flight_start, from, to };
    watch.sensors.watch(&segment, system, watch.step_start);
    watch.flights[index].from = segment.to;
}

/// The flight of a sphere, along which sensors have looked up to `from` \[s\].
fn seen(timeline: &Timeline, slot: u32, from: f64) -> Seen {
    let body = &timeline.flights.bodies[slot as usize];
    let flight = body.flight(timeline.flights.species_of(slot));
    let curve = timeline.flights.curve_of(slot).map(|curve| curve.0);
    Seen {
        flight,
        curve,
        flight_start: body.time,
        generation: body.generation,
        from: body.time.max(from),
    }
}
