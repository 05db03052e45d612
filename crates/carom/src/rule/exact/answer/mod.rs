//! Answers to events: what happens to the spheres of an event, and what it may cost.

pub(crate) mod changed;
mod short_flights;
pub(crate) mod unfinished;

use self::changed::Changed;
use self::unfinished::Unfinished;
use super::predict::prefetch;
use super::{impact, predict, zones};
use crate::rule::exact::context::StepContext;
use crate::rule::exact::events::{Event, EventTarget, NextEvents, PackedTarget, UpcomingEvent};
use crate::rule::exact::persistent::held_forces;
use crate::rule::exact::timeline::Timeline;
use crate::rule::exact::zones::frame_work::UNITS_PER_FLIGHT;

/// The work allowed per sphere and frame is allowed in each part of a longer frame that has this many ticks.
const TICKS_OF_A_FRAME: f64 = 8.0;

/// Answers the next event of the sphere at `slot`. Returns its time \[s\].
pub(crate) fn event(
    timeline: &mut Timeline,
    context: &mut StepContext,
    slot: u32,
    next: UpcomingEvent,
) -> Result<f64, Unfinished> {
    prefetch::upcoming_events(timeline, context.system);
    if !context.work.spend(UNITS_PER_FLIGHT) {
        return Err(Unfinished::Stopped);
    }
    match next {
        UpcomingEvent::CellCrossing(time) => {
            predict::cross_cell(timeline, context, slot, time);
            Ok(time)
        }
        UpcomingEvent::Event(event) if timeline.is_void(&event) => {
            predict::fall_back(timeline, context, slot, event.time);
            Ok(event.time)
        }
        UpcomingEvent::Event(event) => {
            answer_and_check(timeline, context, slot, event)?;
            Ok(event.time)
        }
    }
}

/// Answers an event of the sphere at `slot`, and limits the work of its spheres.
fn answer_and_check(
    timeline: &mut Timeline,
    context: &mut StepContext,
    slot: u32,
    event: Event,
) -> Result<(), Unfinished> {
    let involved = [Some(slot), event.target.slot()];
    let short_flight = short_flights::find(timeline, context, slot, &event);
    let changed = answer(timeline, context, slot, event);
    predict::changed(timeline, context, changed, event.time);
    check_room_to_grow(timeline, context, &involved, event.time)?;
    check_free_of_rest(timeline, context, &involved, event.time)?;
    restart_companions(timeline, context, event.time)?;
    check_work(timeline, context, slot, event.time)?;
    check_steps(timeline, context, event.time);
    if let Some(flight) = short_flight {
        for slot in involved.into_iter().flatten() {
            if short_flights::count(timeline, context, (slot, flight), event.time) {
                make_zone_about(timeline, context, slot, event.time);
            }
        }
    }
    // A sphere that joined a zone moves otherwise than its companions expected.
    restart_companions(timeline, context, event.time)
}

/// Restarts the flights of the companions of restarted spheres, at `time` \[s\].
fn restart_companions(
    timeline: &mut Timeline,
    context: &mut StepContext,
    time: f64,
) -> Result<(), Unfinished> {
    predict::restart_companions(timeline, context, time);
    check_forces(timeline, context, time)
}

/// Answers an event of the sphere at `slot` by its target. Returns the spheres to be predicted.
fn answer(
    timeline: &mut Timeline,
    context: &mut StepContext,
    slot: u32,
    Event { time, target, .. }: Event,
) -> Changed {
    let target = target.unpacked();
    if !matches!(target, EventTarget::Restart | EventTarget::StepEnd) {
        held_forces::prepare(timeline, context.system, time);
    }
    match target {
        EventTarget::Restart => restart(timeline, slot, time),
        EventTarget::StepEnd => next_step(timeline, context, slot, time),
        EventTarget::Cluster => impact::answer_single(timeline, context, slot, None, time),
        EventTarget::Sphere(other) if timeline.flights.growth.is_some() => {
            impact::answer_growing_pair(timeline, context, [slot, other], time)
        }
        EventTarget::Surface(surface) if timeline.flights.growth.is_some() => {
            impact::answer_growing_single(timeline, context, slot, surface, time)
        }
        EventTarget::Sphere(other) if timeline.neighbours.sliding().is_some() => {
            impact::answer_sheared_pair(timeline, context, [slot, other], time)
        }
        EventTarget::Sphere(other)
            if timeline.flights.wells.is_some()
                && impact::meet_at_edge(timeline, context, [slot, other], time) =>
        {
            impact::answer_at_edge(timeline, context, [slot, other], time)
        }
        EventTarget::Sphere(other) => impact::answer_pair(timeline, context, [slot, other], time),
        EventTarget::Surface(surface) => {
            impact::answer_single(timeline, context, slot, Some(surface), time)
        }
    }
}

/// Restarts the flight of a sphere at `time` \[s\].
fn restart(timeline: &mut Timeline, slot: u32, time: f64) -> Changed {
    let (position, velocity) = timeline.flights.state_of(slot, time);
    timeline.flights.count_contact_work(slot, time);
    timeline.begin_flight(slot, position, velocity, time);
    Changed::sphere(slot)
}

/// Begins the next step of the curve of a sphere, where one ends at `time` \[s\].
///
/// Where a companion that flies on no curve ends its flight now, its event restarts this sphere, whichever comes first
/// in the order of spheres. Until then nothing is known of the companion's next flight.
fn next_step(timeline: &mut Timeline, context: &mut StepContext, slot: u32, time: f64) -> Changed {
    if timeline.companion_ends(slot, time) {
        let later = Event::at(time.next_up(), PackedTarget::STEP_END);
        timeline.reschedule(slot, NextEvents::only(later));
        return Changed::NONE;
    }
    timeline.go_on(slot, time);
    timeline.find_curve(context.system, slot);
    timeline.find_clearance(context.system, slot);
    Changed::sphere(slot)
}

/// Returns an error if a force was not finite up to `time` \[s\], or friction has no closed form and nothing is stepped.
/// A force that is first not finite at the end of a frame is an error of the next one.
pub(crate) fn check_forces(
    timeline: &Timeline,
    context: &StepContext,
    time: f64,
) -> Result<(), Unfinished> {
    let is_of_this_frame = time < timeline.frame[1];
    if let Some(index) = timeline.flights.lost.filter(|_| is_of_this_frame) {
        let sphere = context.system.spheres.id[index as usize];
        return Err(Unfinished::NonFiniteForce { sphere });
    }
    if let Some(slot) = context.unanswered {
        let sphere = context.id_of(timeline, slot);
        return Err(Unfinished::NoClosedForm { sphere, time });
    }
    Ok(())
}

/// Returns an error if growth made a sphere so fast, at `time` \[s\], that it has no room left.
fn check_room_to_grow(
    timeline: &Timeline,
    context: &StepContext,
    slots: &[Option<u32>],
    time: f64,
) -> Result<(), Unfinished> {
    if timeline.flights.growth.is_none() {
        return Ok(());
    }
    let mut slots = slots.iter().flatten();
    let overheated = slots.find(|&&slot| timeline.flights.is_overheated(slot));
    overheated.map_or(Ok(()), |&slot| {
        let sphere = context.id_of(timeline, slot);
        Err(Unfinished::NoRoomToGrow { sphere, time })
    })
}

/// Returns an error if a sphere beside a pair potential rests on something, at `time` \[s\].
fn check_free_of_rest(
    timeline: &Timeline,
    context: &StepContext,
    slots: &[Option<u32>],
    time: f64,
) -> Result<(), Unfinished> {
    if timeline.flights.wells.is_none() {
        return Ok(());
    }
    let rests = |slot: &&u32| timeline.flights.species_of(**slot).cluster.is_some();
    slots.iter().flatten().find(rests).map_or(Ok(()), |&slot| {
        let sphere = context.id_of(timeline, slot);
        Err(Unfinished::RestsInPotential { sphere, time })
    })
}

/// Puts a sphere that takes more work in a frame than the parameters allow into a zone, or returns
/// the error.
fn check_work(
    timeline: &mut Timeline,
    context: &mut StepContext,
    slot: u32,
    time: f64,
) -> Result<(), Unfinished> {
    let limit = context.parameters.max_impacts;
    let work = timeline.work_in_frame(slot);
    if work <= u64::from(limit) || timeline.flights.is_stepped(slot) {
        return Ok(());
    }
    if context.has_zones() {
        // A long frame may have as many in each of its parts.
        let parts = (time - context.start) / (TICKS_OF_A_FRAME * context.parameters.zone_tick);
        if work as f64 > f64::from(limit) * parts.ceil().max(1.0) {
            make_zone_about(timeline, context, slot, time);
        }
        return Ok(());
    }
    let sphere = context.id_of(timeline, slot);
    if timeline.has_growth() {
        return Err(Unfinished::NoRoomToGrow { sphere, time });
    }
    let companions = timeline.flights.companions(slot);
    Err(Unfinished::TooManyImpacts { sphere, limit, companions, time })
}

/// Puts spheres whose contacts take more steps of curves than a tick allows into a zone, if there are zones.
fn check_steps(timeline: &mut Timeline, context: &mut StepContext, time: f64) {
    let Some(index) = timeline.spent.take() else { return };
    let slot = timeline.flights.slot_of[index as usize];
    if context.has_zones() && !timeline.flights.is_stepped(slot) {
        make_zone_about(timeline, context, slot, time);
    }
}

/// Makes a zone of a sphere at `time` \[s\], and of what touches it.
fn make_zone_about(timeline: &mut Timeline, context: &mut StepContext, slot: u32, time: f64) {
    let changed = zones::make_zone_about(timeline, context, slot, time);
    predict::changed(timeline, context, changed, time);
}
