//! The course of one sphere: its next impacts and flights, while the others keep their flights.

use super::answer::unfinished::Unfinished;
use super::context::StepContext;
use super::events::{Event, EventTarget, NextEvents, UpcomingEvent};
use super::span::Span;
use super::timeline::Timeline;
use crate::flight::Flight;
use crate::id::SphereId;
use crate::path::{PathEnd, PathLeg};
use crate::polynomial_flight::PolynomialFlight;
use crate::report::{BodyPair, Impact, StepReport};
use crate::system::System;
use crate::work::Work;

/// The course of a sphere over a span.
pub(crate) struct Course {
    pub legs: Vec<PathLeg>,
    /// Impacts of the followed sphere alone.
    pub impacts: Vec<Impact>,
    pub end: PathEnd,
}

/// Follows the sphere at an index of the world's arrays over a span, or up to a number of impacts. Others
/// change their flights only where it strikes them.
///
/// # Errors
/// [`Unfinished::Stopped`] on a stop request.
pub(crate) fn follow(
    timeline: &mut Timeline,
    system: &System,
    (index, most_impacts): (u32, usize),
    span: Span,
    work: &Work,
) -> Result<Course, Unfinished> {
    let slot = timeline.flights.slot_of[index as usize];
    let sphere = system.spheres.id[index as usize];
    let mut report = StepReport::default();
    let mut context = StepContext::new(system, timeline.parameters, span, work, &mut report);
    let mut course = Course { legs: Vec::new(), impacts: Vec::new(), end: PathEnd::Horizon };
    let mut now = span.start;
    let mut leg = leg_of(timeline, slot, now);
    loop {
        if timeline.flights.is_stepped(slot) {
            course.end = PathEnd::NoClosedForm;
        } else if course.impacts.len() >= most_impacts {
            course.end = PathEnd::Impacts;
        }
        let next = match course.end {
            PathEnd::Horizon => timeline.next(span.end),
            PathEnd::Impacts | PathEnd::NoClosedForm => None,
        };
        let Some((at_work, next)) = next else { break };
        now = match answer(timeline, &mut context, slot, (at_work, next)) {
            Ok(time) => time.max(now),
            Err(Unfinished::Stopped) => return Err(Unfinished::Stopped),
            Err(_) => {
                course.end = PathEnd::NoClosedForm;
                break;
            }
        };
        if work.is_stopped() {
            return Err(Unfinished::Stopped);
        }
        course.impacts.extend(context.report.impacts.drain(..).filter(|it| is_of(it, sphere)));
        context.report.groups.clear();
        let next_leg = leg_of(timeline, slot, now);
        if !next_leg.continues(&leg) {
            course.legs.push(PathLeg { end: now, ..leg });
            leg = next_leg;
        }
    }
    let end = if course.end == PathEnd::Horizon { span.end } else { now };
    course.legs.push(PathLeg { end, ..leg });
    Ok(course)
}

/// Answers the next event if it concerns the followed sphere. Returns its time \[s\]. Other spheres only cross
/// cells.
fn answer(
    timeline: &mut Timeline,
    context: &mut StepContext,
    followed: u32,
    (at_work, next): (u32, UpcomingEvent),
) -> Result<f64, Unfinished> {
    if let UpcomingEvent::Event(event) = next
        && !timeline.is_void(&event)
        && !concerns(timeline, followed, at_work, &event)
    {
        meet_only(timeline, context, at_work, followed, event.time);
        return Ok(event.time);
    }
    super::answer::event(timeline, context, at_work, next)
}

/// Whether an event of the sphere at work is one of the sphere that is followed, or of its cluster.
fn concerns(timeline: &Timeline, followed: u32, at_work: u32, event: &Event) -> bool {
    let cluster = |slot: u32| timeline.flights.species_of(slot).cluster;
    let other = match event.target.unpacked() {
        EventTarget::Sphere(other) => other,
        EventTarget::Surface(_)
        | EventTarget::Cluster
        | EventTarget::Restart
        | EventTarget::StepEnd => at_work,
    };
    let is_held_with = |slot: u32| cluster(slot).is_some() && cluster(slot) == cluster(followed);
    [at_work, other].into_iter().any(|slot| slot == followed || is_held_with(slot))
}

/// Predicts the meetings of a sphere with the followed one alone, from `now` \[s\] on.
fn meet_only(
    timeline: &mut Timeline,
    context: &mut StepContext,
    slot: u32,
    followed: u32,
    now: f64,
) {
    let search = &mut context.searches[0];
    search.search_among(timeline, slot, now, |other| other == slot || other == followed);
    let events = search.first_meetings(timeline, slot);
    let is_due = events.first.time >= now;
    timeline.reschedule(slot, if is_due { events } else { NextEvents::NEVER });
}

/// The piece of path that a sphere is on from `now` \[s\] on.
fn leg_of(timeline: &Timeline, slot: u32, now: f64) -> PathLeg {
    let body = &timeline.flights.bodies[slot as usize];
    let curve = timeline.flights.curve_of(slot).map(|curve| curve.0);
    let flight = match &curve {
        Some(PolynomialFlight { position, velocity, acceleration }) => {
            let (position, velocity) = (*position, *velocity);
            Flight { position, velocity, acceleration: acceleration.at(0.0), drag_rate: 0.0 }
        }
        None => body.flight(timeline.flights.species_of(slot)),
    };
    PathLeg { start: now, end: now, flight_start: body.time, flight, curve }
}

fn is_of(impact: &Impact, sphere: SphereId) -> bool {
    match impact.between {
        BodyPair::Spheres(first, second) => first == sphere || second == sphere,
        BodyPair::Collider { sphere: met, .. } => met == sphere,
    }
}
