//! The frame: its beginning, its end, and how added spheres join between frames.

pub(crate) mod arrange;

use std::sync::atomic::{AtomicU64, Ordering};

use glam::DVec3;

use self::arrange::arrange;
use crate::bodies::Motion;
use crate::detect::instant::Instant;
use crate::id::SphereId;
use crate::parallel;
use crate::persistent_contact::PersistentContact;
use crate::report::StepReport;
use crate::rule::exact::context::StepContext;
use crate::rule::exact::events::{Prediction, Schedule};
use crate::rule::exact::flights::{self, Body, Flights, Growth, Rotation, Wells};
use crate::rule::exact::pair_times::PairSearch;
use crate::rule::exact::persistent::{self, held_forces, piece_end};
use crate::rule::exact::predict;
use crate::rule::exact::predict::moving;
use crate::rule::exact::span::Span;
use crate::rule::exact::ticks;
use crate::rule::exact::timeline::Timeline;
use crate::rule::exact::zones;
use crate::rule::exact::zones::zone::Zone;
use crate::settings::{Exact, Zones};
use crate::shear::Shear;
use crate::system::System;
use crate::work::Work;

/// Spheres that were added or removed since the timeline was made.
pub(crate) struct Arrivals<'a, F: Fn(SphereId) -> f64> {
    /// Ids of the spheres that the timeline knows.
    pub known: &'a [SphereId],
    /// When the flight of an added sphere begins, on the world's clock \[s\].
    pub time_of: F,
    /// The next emission, on the world's clock \[s\].
    pub next: f64,
}

/// Begins a flight of every sphere from its state at `time` \[s\]. Spheres of a zone join it again.
pub(crate) fn start(
    system: &System,
    parameters: Exact,
    motion: &Motion,
    mut zone: Zone,
    time: f64,
) -> Timeline {
    let mut flights = Flights::new(system, motion, |_| Err(time));
    let velocities = motion.velocity.iter().copied();
    flights.growth = Growth::of(&flights.species, velocities, time);
    flights.wells = Wells::of(&Instant { system: *system, motion, time });
    // Zones step spheres with the radius of the start, images that stand still, and no wells.
    let excludes_zones =
        flights.growth.is_some() || flights.wells.is_some() || Shear::of(system.settings).is_some();
    let zones = if excludes_zones { Zones::Never } else { parameters.zones };
    let parameters = parameters.with_zones(zones);
    if zones == Zones::Never {
        zone = Zone::default();
    }
    if system.has_friction() {
        let all = 0..motion.position.len();
        flights.rotations = all.map(|index| Rotation::of(motion, index, time)).collect();
    }
    flights.set_stepped(&zone.indices(&system.spheres.id));
    let spring_rate = system.fastest_spring_rate();
    zone.restart(system, (&flights, motion), time, [parameters.zone_tick, spring_rate]);
    let frame = [time; 2];
    let mut timeline = Timeline { parameters, flights, frame, zone, ..Timeline::default() };
    (timeline.spring_rate, timeline.held_until) = (spring_rate, time);
    timeline.curves_until = f64::INFINITY;
    hold_until_ticks(&mut timeline, parameters.force_tick);
    arrange(&mut timeline, system, time);
    timeline.work.begin(&timeline.flights.bodies);
    timeline.find_curves(system);
    timeline.restarted.clear();
    predict_all(&mut timeline, system, time);
    timeline
}

/// Adds, at `time` \[s\], the spheres that were added to the world, and removes those that were removed; the others
/// fly on. Persistent contacts are computed again.
pub(crate) fn adopt<F: Fn(SphereId) -> f64>(
    before: &Timeline,
    system: &System,
    motion: &Motion,
    arrivals: Arrivals<F>,
    time: f64,
) -> Timeline {
    let flight_of = |index: usize| {
        let id = system.spheres.id[index];
        match arrivals.known.binary_search(&id) {
            Ok(index) => Ok(before.flights.free_flight_of(index, time)),
            Err(_) => Err((arrivals.time_of)(id)),
        }
    };
    let mut flights = Flights::new(system, motion, flight_of);
    let frame = before.frame;
    if before.has_friction() || system.has_friction() {
        let rotation_of = |(index, id)| match arrivals.known.binary_search(id) {
            Ok(place) if before.has_friction() => before.flights.free_rotation_of(place, time),
            Ok(_) => Rotation::of(motion, index, frame[0]),
            Err(_) => Rotation::of(motion, index, (arrivals.time_of)(*id)),
        };
        flights.rotations = system.spheres.id.iter().enumerate().map(rotation_of).collect();
    }
    if flights.are_curved() && before.flights.are_curved() {
        for (id, curve) in system.spheres.id.iter().zip(&mut flights.curves) {
            if let Ok(place) = arrivals.known.binary_search(id) {
                *curve = before.flights.curves[place].to_begin();
            }
        }
    }
    let mut zone = before.zone.clone();
    zone.follow(&system.spheres.id);
    flights.set_stepped(&zone.indices(&system.spheres.id));
    resume(before, system, (flights, zone), arrivals.next, time)
}

/// Begins other flights of all spheres at `time` \[s\], within a frame, from the states in the world's arrays.
/// Persistent contacts are computed again, and spheres of a zone join it again.
pub(crate) fn restart(before: &Timeline, system: &System, motion: &Motion, time: f64) -> Timeline {
    let mut flights = Flights::new(system, motion, |_| Err(time));
    flights.wells.clone_from(&before.flights.wells);
    if before.has_friction() {
        let all = 0..motion.position.len();
        flights.rotations = all.map(|index| Rotation::of(motion, index, time)).collect();
    }
    let mut zone = before.zone.clone();
    flights.set_stepped(&zone.indices(&system.spheres.id));
    zone.restart(system, (&flights, motion), time, [before.zone_tick(), before.spring_rate]);
    resume(before, system, (flights, zone), before.next_emission, time)
}

/// Sets the velocity of a sphere in free flight, by its index, relative to the mean flow \[m/s\] at `time` \[s\].
/// Returns that before; `None`, and nothing changes, for a sphere that contacts, zones or curves connect with others.
pub(crate) fn deflect(
    timeline: &mut Timeline,
    system: &System,
    index: usize,
    velocity: DVec3,
    time: f64,
) -> Option<DVec3> {
    let slot = timeline.flights.slot_of[index];
    let species = timeline.flights.species_of(slot);
    if species.cluster.is_some() || species.is_stepped || species.is_curved {
        return None;
    }
    let (position, before) = timeline.flights.state_of(slot, time);
    let flow = Shear::of(system.settings).map_or(DVec3::ZERO, |it| it.velocity_at(position));
    timeline.begin_flight(slot, position, flow + velocity, time);
    timeline.find_clearance(system, slot);
    predict_each(timeline, system, &[slot], time);
    Some(before - flow)
}

/// Continues a frame at `time` \[s\] with these flights and zone. The next spheres are emitted at `next` \[s\].
fn resume(
    before: &Timeline,
    system: &System,
    (flights, zone): (Flights, Zone),
    next: f64,
    time: f64,
) -> Timeline {
    let Timeline { parameters, frame, .. } = *before;
    let mut timeline = Timeline { parameters, flights, frame, zone, ..Timeline::default() };
    arrange(&mut timeline, system, time);
    timeline.work.begin(&timeline.flights.bodies);
    (timeline.force_tick, timeline.spring_rate) = (before.force_tick, before.spring_rate);
    timeline.work_tick = before.work_tick;
    (timeline.next_emission, timeline.curves_until) = (next, before.curves_until);
    if timeline.flights.hold_forces {
        held_forces::renew(&mut timeline, system, time);
    }
    timeline.find_curves(system);
    timeline.restarted.clear();
    predict_all(&mut timeline, system, time);
    timeline
}

/// Prepares a frame from and to these times \[s\]. The next spheres are emitted at `next` \[s\].
///
/// # Errors
/// Springs that are too stiff, or a sphere on which a force is not finite.
pub(crate) fn begin(
    timeline: &mut Timeline,
    system: &System,
    frame: [f64; 2],
    next: f64,
) -> Result<(), HoldError> {
    let goes_on = timeline.frame[1] == frame[0];
    set_frame(timeline, system, frame);
    timeline.next_emission = next;
    let are_applied = !system.spheres.applied_force.is_empty();
    timeline.curves_until = if are_applied { frame[1] } else { f64::INFINITY };
    let is_other_tick = set_force_tick(timeline, frame[1] - frame[0])?;
    let is_renewed = is_other_tick || is_renewal_due(timeline, system, frame[0]);
    let mut renewed = Vec::new();
    if is_renewed {
        renewed = held_forces::renew(timeline, system, frame[0]);
        find_curves(timeline, system, &mut renewed);
        check_accelerations(timeline, system).map_err(HoldError::NotFinite)?;
    }
    let are_curved = timeline.flights.are_curved();
    let are_some_moving = !timeline.moving_surfaces.is_empty();
    if (is_renewed && !are_curved) || are_applied || (are_some_moving && !goes_on) {
        predict_all(timeline, system, frame[0]);
    } else {
        predict_each(timeline, system, &renewed, frame[0]);
        timeline.schedule.tidy();
        if are_some_moving {
            moving::meet_in_frame(timeline, system);
        }
    }
    timeline.work.begin(&timeline.flights.bodies);
    Ok(())
}

/// Begins a frame from and to these times \[s\]. The ticks of zones follow its length.
fn set_frame(timeline: &mut Timeline, system: &System, frame: [f64; 2]) {
    let before = timeline.zone_tick();
    timeline.frame = frame;
    timeline.moving_regions.find(system, frame);
    let tick = timeline.zone_tick();
    if tick != before {
        timeline.zone.follow_tick(system, [tick, timeline.spring_rate]);
    }
}

/// Reason why forces cannot be held.
#[derive(Debug, Clone, Copy)]
pub(crate) enum HoldError {
    /// Motion on springs has this rate \[1/s\], and no force tick follows it.
    TooStiff(f64),
    /// The force on this sphere is not finite.
    NotFinite(SphereId),
}

/// Sets the force tick by the length of frames \[s\] and by springs, also before a sphere needs it: one may be
/// emitted within the frame. Returns whether the ticks of held forces changed.
fn set_force_tick(timeline: &mut Timeline, frame: f64) -> Result<bool, HoldError> {
    let (before, rate) = (timeline.force_tick, timeline.spring_rate);
    let tick = tick_for_springs(rate, timeline.parameters, frame)?;
    hold_until_ticks(timeline, tick);
    Ok(timeline.flights.forces_vary && timeline.force_tick != before)
}

/// Sets how long forces are held: for a tick \[s\], or for a shorter time where springs need it.
fn hold_until_ticks(timeline: &mut Timeline, tick: f64) {
    timeline.work_tick = tick;
    timeline.force_tick =
        ticks::part(tick, ticks::halvings_for_springs(timeline.spring_rate, tick));
}

/// The force tick \[s\] in frames of this length \[s\], before springs of this rate \[1/s\] make it shorter.
///
/// # Errors
/// Springs that no part of it follows.
pub(crate) fn tick_for_springs(rate: f64, parameters: Exact, frame: f64) -> Result<f64, HoldError> {
    let tick = ticks::tick_for_frames(parameters.force_tick, frame, ticks::MOST_FORCE_TICKS);
    let longest = match parameters.zones {
        Zones::Never => tick,
        Zones::Automatic => tick.max(ticks::zone_tick(parameters, frame)),
    };
    if ticks::can_follow_springs(rate, longest) { Ok(tick) } else { Err(HoldError::TooStiff(rate)) }
}

/// Whether forces are computed at the start of a frame \[s\]: forces that are held over a frame always, others at a
/// force tick.
fn is_renewal_due(timeline: &Timeline, system: &System, start: f64) -> bool {
    let Flights { hold_forces, forces_vary, .. } = timeline.flights;
    let are_applied = !system.spheres.applied_force.is_empty();
    hold_forces && (are_applied || !forces_vary || timeline.held_until <= start)
}

/// Computes the held forces at a force tick, which is now \[s\]. Returns the number of flights that restarted.
///
/// # Errors
/// A sphere on which a force is not finite.
pub(crate) fn force_tick(
    timeline: &mut Timeline,
    system: &System,
    now: f64,
) -> Result<u64, SphereId> {
    let before: Vec<u32> = timeline.flights.bodies.iter().map(|body| body.generation).collect();
    let mut renewed = held_forces::renew(timeline, system, now);
    timeline.work.pass_over(&before, &timeline.flights.bodies);
    find_curves(timeline, system, &mut renewed);
    check_accelerations(timeline, system)?;
    if timeline.flights.are_curved() {
        predict_each(timeline, system, &renewed, now);
    } else {
        predict_all(timeline, system, now);
    }
    Ok(renewed.len() as u64)
}

/// Computes all flights that are not known, and those of companions of restarted spheres. Adds these to the slots
/// to be predicted.
fn find_curves(timeline: &mut Timeline, system: &System, begun: &mut Vec<u32>) {
    timeline.find_curves(system);
    timeline.restart_companions(system);
    begun.append(&mut timeline.restarted);
}

/// Predicts the next events of some spheres, as of `time` \[s\].
fn predict_each(timeline: &mut Timeline, system: &System, slots: &[u32], time: f64) {
    let mut search = PairSearch::default();
    for &slot in slots {
        let prediction = predict::prediction(timeline, system, slot, &mut search, time);
        timeline.enter(slot, prediction);
    }
    let counts = &mut timeline.work.unreported;
    counts.predictions += slots.len() as u64;
    counts.pair_tests += search.tests();
}

/// Returns an error for a force that is not finite, with the sphere on which it acts.
fn check_accelerations(timeline: &Timeline, system: &System) -> Result<(), SphereId> {
    let Flights { bodies, species, index_of, lost, .. } = &timeline.flights;
    if let Some(index) = *lost {
        return Err(system.spheres.id[index as usize]);
    }
    let is_lost = |body: &Body| !species[body.species as usize].acceleration.is_finite();
    let lost = bodies.iter().position(is_lost);
    lost.map_or(Ok(()), |slot| Err(system.spheres.id[index_of[slot] as usize]))
}

/// Writes the states of all spheres at the end of a part of a step.
///
/// # Errors
/// The index of a sphere whose state is not finite, and which of its quantities is not; then nothing
/// is written.
pub(crate) fn end(
    timeline: &Timeline,
    system: &System,
    motion: &mut Motion,
    span: Span,
) -> Result<(), (usize, &'static str)> {
    if let Some(lost) = flights::first_lost(&timeline.flights, span.end) {
        return Err(lost);
    }
    write_motion(timeline, system, motion, span.end);
    flights::write_spin(&timeline.flights.rotations, motion, span.end);
    reading(system, timeline.parameters, span, |context| {
        piece_end::write_motion(timeline, context, motion, span.end);
    });
    zones::write_velocities(timeline, &system.spheres.id, motion, span.end);
    Ok(())
}

/// Writes where all spheres are at `time` \[s\], and their velocities.
fn write_motion(timeline: &Timeline, system: &System, motion: &mut Motion, time: f64) {
    let Some(shear) = Shear::of(system.settings) else {
        let period = system.settings.boundary.period();
        return flights::write_motion(&timeline.flights, motion, period, time);
    };
    flights::write_motion(&timeline.flights, motion, DVec3::INFINITY, time);
    for (place, velocity) in motion.position.iter_mut().zip(&mut motion.velocity) {
        [*place, *velocity] = shear.wrapped([*place, *velocity], time);
    }
}

/// The work of moving colliders \[J\] that the states written at `time` \[s\] have beyond that of the flights.
pub(crate) fn work_written(
    timeline: &Timeline,
    system: &System,
    motion: &Motion,
    time: f64,
) -> f64 {
    piece_end::work_written(timeline, motion, system.settings.boundary.period(), time)
}

/// Runs `read` on a world without reporting anything or counting its work.
fn reading<T>(
    system: &System,
    parameters: Exact,
    span: Span,
    read: impl FnOnce(&StepContext) -> T,
) -> T {
    let (report, work) = (&mut StepReport::default(), &Work::unlimited());
    read(&StepContext::new(system, parameters, span, work, report))
}

/// The contacts that persist now, at `time` \[s\], when surfaces are where the system says.
pub(crate) fn persistent_contacts(
    timeline: &Timeline,
    system: &System,
    time: f64,
) -> Vec<PersistentContact> {
    let now = Span { start: time, length: 0.0, end: time };
    let mut contacts = reading(system, timeline.parameters, now, |context| {
        persistent::list(timeline, context, time)
    });
    let stepped = timeline.zone.persistent_contacts(system);
    if !stepped.is_empty() {
        contacts.extend(stepped);
        contacts.sort_by_key(|contact| contact.between);
    }
    contacts
}

/// Orders the spheres and predicts all their events, at `now` \[s\]. This follows the event that makes it due, not
/// the start of a frame: it predicts meetings again that were passed over, so results would depend on the frames.
#[cold]
#[inline(never)]
pub(crate) fn rearrange(timeline: &mut Timeline, system: &System, now: f64) {
    arrange(timeline, system, now);
    predict_all(timeline, system, now);
}

/// Predicts the next event of every sphere, as of `time` \[s\].
fn predict_all(timeline: &mut Timeline, system: &System, time: f64) {
    timeline.schedule = Schedule::default();
    let count = timeline.flights.bodies.len();
    let known = &*timeline;
    // A sum of integers is the same in any order.
    let pair_tests = AtomicU64::new(0);
    let predictions: Vec<Prediction> = parallel::map(count, |search: &mut PairSearch, slot| {
        let before = search.tests();
        let prediction = predict::prediction(known, system, slot as u32, search, time);
        pair_tests.fetch_add(search.tests() - before, Ordering::Relaxed);
        prediction
    });
    let counts = &mut timeline.work.unreported;
    counts.predictions += count as u64;
    counts.pair_tests += pair_tests.into_inner();
    let horizon = timeline.horizon();
    timeline.schedule = Schedule::new(predictions, &timeline.flights.index_of, horizon);
}
