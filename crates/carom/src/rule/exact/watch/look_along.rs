//! Looks along the flights of all spheres when they end, for sensors and for the work of forces.

use glam::DVec3;

use super::Watch;
use super::seen::Seen;
use crate::forces;
use crate::id::SphereId;
use crate::rule::exact::flights::ContactWork;
use crate::rule::exact::timeline::Timeline;
use crate::sensor::FlightSegment;
use crate::system::System;

/// Begins to watch all flights at `now` \[s\].
pub(crate) fn begin(timeline: &mut Timeline, system: &System, mut watch: Watch, now: f64) {
    let slots = &timeline.flights.slot_of;
    watch.flights = slots.iter().map(|&slot| seen(timeline, system, slot, now)).collect();
    watch.begun.clear();
    if let Some(tally) = &mut watch.tally {
        tally.restart(system, now);
    }
    timeline.watch = Some(Box::new(watch));
}

/// Looks along the flights that ended since the last look.
#[inline]
pub(crate) fn follow(timeline: &mut Timeline, system: &System) {
    if timeline.watch.as_ref().is_some_and(|watch| !watch.begun.is_empty()) {
        look_along_ended(timeline, system);
    }
}

#[inline(never)]
fn look_along_ended(timeline: &mut Timeline, system: &System) {
    let Some(mut watch) = timeline.watch.take() else { return };
    let mut begun = std::mem::take(&mut watch.begun);
    begun.sort_unstable();
    begun.dedup();
    let (index_of, bodies) = (&timeline.flights.index_of, &timeline.flights.bodies);
    begun.retain(|&slot| {
        let index = index_of[slot as usize] as usize;
        bodies[slot as usize].generation != watch.flights[index].generation
    });
    // A spring needs the old flights of both of its ends, an interaction those of all spheres.
    for &slot in &begun {
        let index = index_of[slot as usize];
        look_along(&mut watch, timeline, system, index as usize, bodies[slot as usize].time);
        if let Some(tally) = &mut watch.tally {
            let now = watch.flights[index as usize].from;
            tally.follow_springs(index, &watch.flights, system, now);
            tally.follow_interactions(&watch.flights, system, now);
        }
    }
    for &slot in &begun {
        let index = index_of[slot as usize] as usize;
        watch.flights[index] = seen(timeline, system, slot, watch.flights[index].from);
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
    if let Some(tally) = &mut watch.tally {
        tally.follow_all_springs(&watch.flights, system, now);
        tally.follow_interactions(&watch.flights, system, now);
    }
    Some(watch)
}

/// Looks along the flight of a sphere up to `to` \[s\].
fn look_along(watch: &mut Watch, timeline: &Timeline, system: &System, index: usize, to: f64) {
    let seen = watch.flights[index];
    let Seen { flight, curve, flight_start, from, .. } = seen;
    let sphere: SphereId = system.spheres.id[index];
    let radius = timeline.flights.species_of(timeline.flights.slot_of[index]).radius;
    let to = to.max(from);
    let index_of = index as u32;
    let segment =
        FlightSegment { sphere, index: index_of, radius, flight, curve, flight_start, from, to };
    if let Some(sensors) = &mut watch.sensors {
        sensors.watch(&segment, system, watch.step_start);
    }
    if let Some(tally) = &mut watch.tally {
        tally.follow(&segment, &seen, system);
    }
    watch.flights[index].from = segment.to;
}

/// The flight of a sphere, along which the watch has looked up to `from` \[s\].
fn seen(timeline: &Timeline, system: &System, slot: u32, from: f64) -> Seen {
    let body = &timeline.flights.bodies[slot as usize];
    let species = timeline.flights.species_of(slot);
    let index = timeline.flights.index_of[slot as usize] as usize;
    let curve = timeline.flights.curve_of(slot).map(|curve| curve.0);
    let working = timeline.working_forces.get(index).filter(|_| curve.is_none());
    let working_force = working.copied().unwrap_or(DVec3::ZERO);
    let held_force = held_force(timeline, system, slot).map(|force| force - working_force);
    Seen {
        flight: body.flight(species),
        curve,
        flight_start: body.time,
        generation: body.generation,
        is_stepped: species.is_stepped,
        working_force,
        held_force: held_force.filter(|_| curve.is_none()),
        from: body.time.max(from),
    }
}

/// The force \[N\] under which a sphere flies where it is held constant, without that of contacts, without the linear
/// one that has no potential, and without the applied one; `None` where it is not held, or where spheres are too many
/// to take their steps together.
fn held_force(timeline: &Timeline, system: &System, slot: u32) -> Option<DVec3> {
    let flights = &timeline.flights;
    if !flights.forces_vary || system.holds_forces_of_all() {
        return None;
    }
    let species = flights.species_of(slot);
    let index = flights.index_of[slot as usize] as usize;
    if species.is_stepped {
        return Some(timeline.zone.force_on(index as u32, system.spheres.id[index]));
    }
    if species.cluster.is_none() || species.is_curved {
        return None;
    }
    let acceleration = match species.contact_work {
        // Contacts that do no work are among the forces: what they do by rounding is no work of their own.
        ContactWork::None => species.acceleration,
        _ => flights.free_species_of(slot).acceleration,
    };
    let (radius, mass) = (species.radius, species.mass);
    let (linear, _) = forces::nonconservative_linear(system.forces, radius, mass);
    let applied = system.spheres.applied_acceleration(index).unwrap_or(DVec3::ZERO);
    Some(mass * (acceleration - linear.acceleration - applied))
}
