//! Prediction: what a sphere meets next.

pub(crate) mod moving;
pub(crate) mod near_surfaces;
pub(crate) mod prefetch;

use glam::DVec3;

use crate::contact_time::{self, Reach};
use crate::detect::contact::Bodies;
use crate::detect::sphere_surface;
use crate::norm::Norm;
use crate::rule::exact::answer::changed::{Changed, Unresolved};
use crate::rule::exact::contacts::{MOST_PLANES, Plane};
use crate::rule::exact::context::StepContext;
use crate::rule::exact::events::{Event, EventTarget, NextEvents, PackedTarget, Prediction};
use crate::rule::exact::flights::{Body, Species};
use crate::rule::exact::pair_times::{NearTest, PairSearch};
use crate::rule::exact::timeline::Timeline;
use crate::rule::exact::zones::frame_work::UNITS_PER_FLIGHT;
use crate::system::System;

/// Way up to an event, as a part of the radius, below which what comes after the event is left to be found then.
const SOON: f64 = 1.0 / 32.0;

/// Predicts what the spheres that an answer changed meet next, as of `now` \[s\], and enters it into the schedule.
#[inline]
pub(crate) fn changed(
    timeline: &mut Timeline,
    context: &mut StepContext,
    changed: Changed,
    now: f64,
) {
    match changed {
        Changed::Pair { slots, are_searched } => {
            for one in 0..2 {
                if are_searched[one] {
                    enter_found(timeline, context, slots[one], one, now);
                } else {
                    predict(timeline, context, slots[one], now);
                }
            }
        }
        Changed::Sphere { slot, unresolved } => {
            predict(timeline, context, slot, now);
            pass_over(timeline, context, slot, &unresolved, now);
        }
        Changed::Group { slots, unresolved } => {
            slots.iter().for_each(|&slot| predict(timeline, context, slot, now));
            slots.iter().for_each(|&slot| pass_over(timeline, context, slot, &unresolved, now));
        }
        Changed::Joined { slots } => {
            for slot in slots {
                predict(timeline, context, slot, now);
                timeline.note_near_zone(slot, &context.searches[0].near);
            }
        }
    }
}

/// Enters the next events of one of two spheres whose neighbours an answer has searched, as of `now` \[s\].
#[inline(always)]
fn enter_found(
    timeline: &mut Timeline,
    context: &mut StepContext,
    slot: u32,
    one: usize,
    now: f64,
) {
    context.counts.predictions += 1;
    let search = &context.searches[one];
    let prediction = prediction_from_found(timeline, context.system, slot, search, now);
    timeline.enter(slot, prediction);
}

/// Predicts what a sphere meets next as of `now` \[s\], and enters it into the schedule.
pub(crate) fn predict(timeline: &mut Timeline, context: &mut StepContext, slot: u32, now: f64) {
    timeline.find_curve(context.system, slot);
    enter(timeline, context, slot, now);
    predict_restarted(timeline, context, now);
}

/// Predicts the next events of spheres whose flights restarted `now` \[s\] with those of companions.
pub(crate) fn predict_restarted(timeline: &mut Timeline, context: &mut StepContext, now: f64) {
    if timeline.restarted.is_empty() {
        return;
    }
    let mut restarted = std::mem::take(&mut timeline.restarted);
    for &slot in &restarted {
        timeline.find_clearance(context.system, slot);
        enter(timeline, context, slot, now);
    }
    context.renewed += restarted.len() as u64;
    context.work.spend(UNITS_PER_FLIGHT * restarted.len() as u64);
    restarted.clear();
    timeline.restarted = restarted;
}

/// Enters the next events of a sphere as of `now` \[s\] into the schedule.
fn enter(timeline: &mut Timeline, context: &mut StepContext, slot: u32, now: f64) {
    context.counts.predictions += 1;
    let prediction = prediction(timeline, context.system, slot, &mut context.searches[0], now);
    timeline.enter(slot, prediction);
}

/// Restarts the flights of the companions of restarted spheres, `now` \[s\].
#[inline]
pub(crate) fn restart_companions(timeline: &mut Timeline, context: &mut StepContext, now: f64) {
    if timeline.flights.are_curved() {
        timeline.restart_companions(context.system);
        predict_restarted(timeline, context, now);
    }
}

/// Moves a sphere to its second event, where the other sphere of its first one, due `now` \[s\], restarted before.
/// That sphere's pair search found this one, so this one need not search again.
pub(crate) fn fall_back(timeline: &mut Timeline, context: &mut StepContext, slot: u32, now: f64) {
    match timeline.schedule.next_events(slot).without_first() {
        Some(rest) if rest.first.is_never() || !timeline.is_void(&rest.first) => {
            timeline.reschedule(slot, rest)
        }
        _ => predict(timeline, context, slot, now),
    }
}

/// The next events of a sphere as of `now` \[s\].
///
/// Times follow from the flights alone: either sphere, and whenever it predicts a meeting, finds the
/// same time to the bit.
pub(crate) fn prediction(
    timeline: &Timeline,
    system: &System,
    slot: u32,
    search: &mut PairSearch,
    now: f64,
) -> Prediction {
    search.search(timeline, slot, now, NearTest::none(slot));
    prediction_from_found(timeline, system, slot, search, now)
}

/// The next events of a sphere among the neighbours that a pair search has found.
#[inline(always)]
fn prediction_from_found(
    timeline: &Timeline,
    system: &System,
    slot: u32,
    search: &PairSearch,
    now: f64,
) -> Prediction {
    let events = search.first_meetings(timeline, slot);
    let sought = Sought { now, ..Sought::default() };
    prediction_after(timeline, system, slot, events, sought)
}

/// Which meetings with surfaces are sought.
#[derive(Debug, Clone, Copy, Default)]
struct Sought<'a> {
    /// From when on \[s\].
    now: f64,
    /// Bodies that the sphere passes over.
    passed: &'a [Bodies],
    /// Whether those with surfaces that move are known.
    only_at_rest: bool,
}

/// The next events of a sphere whose meetings with other spheres are known.
#[inline(always)]
fn prediction_after(
    timeline: &Timeline,
    system: &System,
    slot: u32,
    mut events: NextEvents,
    sought: Sought,
) -> Prediction {
    let now = sought.now;
    let body = &timeline.flights.bodies[slot as usize];
    let species = &timeline.flights.species[body.species as usize];
    let (neighbours, horizon) = (&timeline.neighbours, timeline.flight_end(slot, species));
    let curve = if species.is_curved { timeline.flights.curve_of(slot) } else { None };
    let stays = match &curve {
        Some((flight, _)) => {
            neighbours.stays_within(slot, species.level, body.position, flight.farthest())
        }
        None => horizon < f64::INFINITY && neighbours.stays(slot, body, species, horizon),
    };
    let meets_none = system.surfaces.is_empty() || species.is_stepped;
    if !(meets_none || (stays && timeline.is_clear_of_surfaces(slot))) {
        meet_surfaces(timeline, system, slot, (body, species), sought, &mut events);
    }
    if let Some(cluster) = species.cluster {
        let time = timeline.flights.clusters.renewal_by(cluster, slot);
        events.add(Event::at(time, PackedTarget::CLUSTER));
    }
    if let Some((_, end)) = curve {
        events.add(Event::at(end, PackedTarget::STEP_END));
    }
    if events.first.time < now {
        // It was passed over. A new flight finds it again only if the bodies close.
        events = NextEvents::only(Event::at(now, PackedTarget::RESTART));
    }
    let cell_crossing = match &curve {
        _ if stays => f64::INFINITY,
        Some((flight, _)) => {
            let state = timeline.flights.state_of(slot, now);
            let bounds = flight.acceleration.bounds();
            neighbours.crossing_time_within((slot, species.level), state, bounds, now)
        }
        None => neighbours.crossing_time(slot, body, species, now),
    };
    Prediction { events, cell_crossing }
}

/// Removes those meetings from the next events of a sphere that need no answer `now` \[s\]. Another flight begins after
/// them; earlier events stay as predicted.
fn pass_over(
    timeline: &mut Timeline,
    context: &mut StepContext,
    slot: u32,
    meetings: &[Unresolved],
    now: f64,
) {
    let sphere = timeline.flights.index_of[slot as usize];
    let unresolved_until = |event: &Event| {
        let bodies = bodies_of(timeline, sphere, event)?;
        let meeting = meetings.iter().find(|meeting| meeting.bodies == bodies)?;
        (event.time < meeting.until).then_some(meeting.until)
    };
    let predicted = timeline.schedule.next_events(slot);
    let mut events = Some(predicted);
    let mut restart = Event::at(f64::INFINITY, PackedTarget::RESTART);
    while let Some(until) = events.and_then(|events| unresolved_until(&events.first)) {
        restart.time = restart.time.min(until);
        events = events.and_then(NextEvents::without_first);
    }
    if events == Some(predicted) {
        return;
    }
    restart.time = restart.time.min(timeline.flights.step_end(slot));
    // Only the first two meetings are known.
    let is_far = restart.time - now > 2.0 * context.parameters.contact_duration;
    let next = match events {
        None if is_far => first_but(timeline, context, slot, meetings, now),
        _ => events.map(|events| events.first),
    };
    let next = next.filter(|next| next.time < restart.time);
    timeline.reschedule(slot, NextEvents::only(next.unwrap_or(restart)));
}

/// The bodies that a sphere, by its index, meets in an event; `None` if it meets none.
fn bodies_of(timeline: &Timeline, sphere: u32, event: &Event) -> Option<Bodies> {
    match event.target.unpacked() {
        EventTarget::Sphere(other) => {
            Some(Bodies::pair([sphere, timeline.flights.index_of[other as usize]]))
        }
        EventTarget::Surface(surface) => Some(Bodies::Surface { sphere, surface }),
        EventTarget::Cluster | EventTarget::Restart | EventTarget::StepEnd => None,
    }
}

/// The bodies of the meeting that a sphere has at this very time \[s\], if it has one then.
pub(crate) fn meeting_at(timeline: &Timeline, slot: u32, time: f64) -> Option<Bodies> {
    let event = timeline.schedule.next_events(slot).first;
    let is_due = event.time == time && !timeline.is_void(&event);
    is_due.then(|| bodies_of(timeline, timeline.flights.index_of[slot as usize], &event))?
}

/// The first event of a sphere as of `now` \[s\], without these meetings.
fn first_but(
    timeline: &Timeline,
    context: &mut StepContext,
    slot: u32,
    meetings: &[Unresolved],
    now: f64,
) -> Option<Event> {
    let sphere = timeline.flights.index_of[slot as usize];
    let passed: Vec<Bodies> = meetings.iter().map(|meeting| meeting.bodies).collect();
    let search = &mut context.searches[0];
    search.search_among(timeline, slot, now, |other| {
        let other = timeline.flights.index_of[other as usize];
        other == sphere || !passed.contains(&Bodies::pair([sphere, other]))
    });
    let events = search.first_meetings(timeline, slot);
    let sought = Sought { now, passed: &passed, only_at_rest: false };
    let prediction = prediction_after(timeline, context.system, slot, events, sought);
    Some(prediction.events.first)
}

/// Moves a sphere that leaves its neighbour region at `now` \[s\] to the next one, and searches for
/// what it may meet there.
pub(crate) fn cross_cell(timeline: &mut Timeline, context: &mut StepContext, slot: u32, now: f64) {
    context.counts.predictions += 1;
    let state = timeline.flights.state_of(slot, now);
    let shift = timeline.neighbours.shift_from_box(slot);
    let search = &mut context.searches[0];
    timeline.cross_cell(slot, state.into(), &mut search.near);
    if timeline.neighbours.has_left_sheared_box(slot) {
        timeline.begin_flight(slot, state.0, state.1, now);
        return predict(timeline, context, slot, now);
    }
    let mut events = timeline.schedule.next_events(slot);
    search.search_found(timeline, slot, now);
    timeline.note_near_zone(slot, &search.near);
    let found = search.first_meetings(timeline, slot);
    events.add(found.first);
    events.add(found.second);
    // Those with surfaces that move are known for the whole frame, beside this image.
    let only_at_rest = timeline.neighbours.shift_from_box(slot) == shift;
    let sought = Sought { now, passed: &[], only_at_rest };
    let prediction = prediction_after(timeline, context.system, slot, events, sought);
    timeline.enter(slot, prediction);
}

/// Adds the surfaces near it that a sphere meets to its next events.
fn meet_surfaces(
    timeline: &Timeline,
    system: &System,
    slot: u32,
    (body, species): (&Body, &Species),
    Sought { now, passed, only_at_rest }: Sought,
    events: &mut NextEvents,
) {
    let sphere = timeline.flights.index_of[slot as usize];
    let flight_end = timeline.flight_end(slot, species);
    let horizon = if species.is_curved { flight_end } else { timeline.horizon() };
    if timeline.flights.growth.is_some() {
        return meet_surfaces_growing(timeline, system, slot, events);
    }
    let center = body.position;
    let planes = planes_that_hold(timeline, system, slot);
    let is_soon = comes_soon(events.first.time - body.time, (body, species));
    let mut is_second_known = true;
    let (mut reach, mut reach_until) = (None, f64::INFINITY);
    for (number, shift) in timeline.surfaces_at_rest_near(slot) {
        // What is met after two known events changes nothing.
        let known = if is_soon { events.first.time } else { events.known_until() };
        let until = flight_end.min(known).max(body.time);
        if until < reach_until && !(species.is_curved && reach.is_some()) {
            (reach, reach_until) = (Some(timeline.flights.reach_of(slot, until)), until);
        }
        let (form, motion) = system.surfaces[number as usize].place();
        let is_missed = |reach: Reach| reach.misses(form, shift);
        if reach.is_some_and(is_missed) {
            is_second_known &= !is_soon;
            continue;
        }
        let is_passed = passed.contains(&Bodies::Surface { sphere, surface: number });
        if is_passed || timeline.flights.is_held_by(slot, number) {
            continue;
        }
        let is_above = |plane: &Plane| plane.is_above(form, shift, center);
        if planes.iter().flatten().any(is_above) {
            continue;
        }
        let track = timeline.flights.track_from(slot, body.time).shifted(-shift);
        let (radius, horizon) = (species.radius, horizon - body.time);
        let delay = contact_time::track_surface(&track, radius, form, motion, None, horizon);
        if let Some(delay) = delay {
            events.add(Event::at(body.time + delay, PackedTarget::surface(number)));
        }
    }
    if !is_second_known {
        *events = NextEvents::only(events.first);
    }
    if !timeline.moving_surfaces.is_empty() && !only_at_rest {
        moving::meet_near((timeline, system), (slot, now), passed, events);
    }
}

/// Whether a sphere hardly moves up to an event after a `delay` \[s\]: hardly anything comes between, and what follows
/// is found after it.
fn comes_soon(delay: f64, (body, species): (&Body, &Species)) -> bool {
    let acceleration = species.acceleration.norm() + species.drag_rate * body.velocity.norm();
    let way = delay * (body.velocity.norm() + 0.5 * delay * acceleration);
    !species.is_curved && way < SOON * species.radius
}

/// Adds the surfaces near it that a sphere meets as it grows to its next events.
fn meet_surfaces_growing(timeline: &Timeline, system: &System, slot: u32, events: &mut NextEvents) {
    let body = &timeline.flights.bodies[slot as usize];
    let species = timeline.flights.species_of(slot);
    let radius = timeline.flights.radius_at(slot, body.time);
    for (number, shift) in timeline.surfaces_with(slot, &timeline.moving_surfaces) {
        let mut flight = body.flight(species);
        flight.position -= shift;
        let growing = [radius, species.growth_speed];
        let form = &system.surfaces[number as usize].form;
        let delay = contact_time::growing_sphere_surface(&flight, growing, form, f64::INFINITY);
        if let Some(delay) = delay {
            events.add(Event::at(body.time + delay, PackedTarget::surface(number)));
        }
    }
}

/// The planes at rest on which a sphere lies; in a periodic box their nearest images.
fn planes_that_hold<'a>(
    timeline: &Timeline,
    system: &System<'a>,
    slot: u32,
) -> [Option<Plane<'a>>; MOST_PLANES] {
    let mut planes = [None; MOST_PLANES];
    let flights = &timeline.flights;
    let Some(cluster) = flights.species_of(slot).cluster else { return planes };
    let is_periodic = system.settings.boundary.is_periodic();
    let body = &flights.bodies[slot as usize];
    let surfaces = flights.clusters.get(cluster).surfaces_of(flights.index_of[slot as usize]);
    let under = surfaces.filter_map(|surface| {
        let image =
            if is_periodic { nearest_image(timeline, system, surface, slot)? } else { DVec3::ZERO };
        let state = [body.position - image, body.velocity];
        Some(Plane::under(state, surface, system.surfaces)?.at_image(image))
    });
    planes.iter_mut().zip(under).for_each(|(place, plane)| *place = Some(plane));
    planes
}

/// Offset of the image of a surface that is nearest to a sphere \[m\].
fn nearest_image(timeline: &Timeline, system: &System, surface: u32, slot: u32) -> Option<DVec3> {
    let form = &system.surfaces[surface as usize].form;
    let place = timeline.flights.bodies[slot as usize].position;
    let distance = |shift: &DVec3| {
        let separation = sphere_surface(form, place - *shift, 0.0);
        separation.map_or(f64::INFINITY, |separation| separation.distance)
    };
    let near = timeline.images_of(system, slot, surface);
    near.map(|(_, shift)| shift).min_by(|a, b| distance(a).total_cmp(&distance(b)))
}
