//! What a sphere comes upon next.

use glam::DVec3;

use super::body::{Body, Kind};
use super::outlook::{Ahead, Event, Outlook, Target, Upon};
use super::stage::Stage;
use super::surroundings::Surroundings;
use super::timeline::Timeline;
use crate::contact_time::{self, Reach};
use crate::detect::contact::Bodies;
use crate::system::System;

/// Predicts what a sphere meets next as of `now` \[s\], and notes it.
pub(super) fn predict(timeline: &mut Timeline, stage: &mut Stage, slot: u32, now: f64) {
    let outlook = outlook(timeline, stage.system, slot, &mut stage.around[0], now);
    timeline.schedule(slot, outlook);
}

/// Lets a sphere go on to what it meets next, where the other one of a meeting that is due `now` \[s\]
/// began another flight before. A sphere that begins a flight looks at all around it, so that this one
/// need not look at it again.
pub(super) fn fall_back(timeline: &mut Timeline, stage: &mut Stage, slot: u32, now: f64) {
    match timeline.outlooks[slot as usize].ahead.without_first() {
        Some(rest) if rest.first.is_never() || !timeline.is_void(&rest.first) => {
            timeline.reschedule(slot, rest)
        }
        _ => predict(timeline, stage, slot, now),
    }
}

/// What lies ahead of a sphere as of `now` \[s\].
///
/// Times follow from the flights alone: either sphere, and whenever it predicts a meeting, finds the
/// same time to the bit.
pub(super) fn outlook(
    timeline: &Timeline,
    system: &System,
    slot: u32,
    around: &mut Surroundings,
    now: f64,
) -> Outlook {
    around.look(timeline, slot, now, (slot, 0.0));
    outlook_from_here(timeline, system, slot, around, now)
}

/// What lies ahead of a sphere that has looked around.
#[inline(always)]
pub(super) fn outlook_from_here(
    timeline: &Timeline,
    system: &System,
    slot: u32,
    around: &Surroundings,
    now: f64,
) -> Outlook {
    let ahead = around.first_meetings(timeline, slot);
    outlook_after(timeline, system, slot, ahead, now)
}

/// What lies ahead of a sphere whose meetings with others are known.
#[inline(always)]
fn outlook_after(
    timeline: &Timeline,
    system: &System,
    slot: u32,
    mut ahead: Ahead,
    now: f64,
) -> Outlook {
    let body = &timeline.bodies[slot as usize];
    let kind = &timeline.kinds[body.kind as usize];
    let (neighbours, horizon) = (&timeline.neighbours, timeline.flight_end(kind));
    let stays = horizon < f64::INFINITY && neighbours.stays(slot, body, kind, horizon);
    if !(system.surfaces.is_empty() || (stays && timeline.has_room(slot))) {
        meet_surfaces(timeline, system, slot, body, kind, &mut ahead);
    }
    if let Some(cluster) = kind.cluster {
        let time = timeline.clusters.renewal_by(cluster, slot);
        ahead.add(Event { time, target: Target::CLUSTER, flights: 0 });
    }
    if ahead.first.time < now {
        // It was passed over. From the start of another flight it is found again only if it closes.
        ahead = Ahead::only(Event { time: now, target: Target::RESTART, flights: 0 });
    }
    let departure = if stays { f64::INFINITY } else { neighbours.departure(slot, body, kind, now) };
    Outlook { ahead, departure }
}

/// Two bodies that touch, and for how long a meeting of them has nothing to answer.
///
/// Two bodies that hardly touch may meet, by the rounding of one formula, and have nothing to
/// answer, by that of another.
#[derive(Debug, Clone, Copy)]
pub(super) struct Unresolved {
    pub bodies: Bodies,
    /// On the world's clock \[s\].
    pub until: f64,
}

/// Lets a sphere pass over meetings that have nothing to answer, to begin another flight after them.
/// What else it meets before comes as predicted.
pub(super) fn pass_over(timeline: &mut Timeline, slot: u32, meetings: &[Unresolved]) {
    let sphere = timeline.index_of[slot as usize];
    let unresolved_until = |event: &Event| {
        let bodies = match event.target.upon() {
            Upon::Sphere(other) => Bodies::pair([sphere, timeline.index_of[other as usize]]),
            Upon::Surface(surface) => Bodies::Surface { sphere, surface },
            Upon::Cluster | Upon::Restart => return None,
        };
        let meeting = meetings.iter().find(|meeting| meeting.bodies == bodies)?;
        (event.time < meeting.until).then_some(meeting.until)
    };
    let predicted = timeline.outlooks[slot as usize].ahead;
    let mut ahead = Some(predicted);
    let mut restart = Event { time: f64::INFINITY, target: Target::RESTART, flights: 0 };
    while let Some(until) = ahead.and_then(|ahead| unresolved_until(&ahead.first)) {
        restart.time = restart.time.min(until);
        ahead = ahead.and_then(Ahead::without_first);
    }
    if ahead != Some(predicted) {
        let next = ahead.map(|ahead| ahead.first).filter(|next| next.time < restart.time);
        timeline.reschedule(slot, Ahead::only(next.unwrap_or(restart)));
    }
}

/// Begins another flight of a sphere from where it is at `now` \[s\].
pub(super) fn restart(timeline: &mut Timeline, stage: &mut Stage, slot: u32, now: f64) {
    let (position, velocity) = timeline.state_of(slot, now);
    timeline.begin_flight(slot, position, velocity, now);
    predict(timeline, stage, slot, now);
}

/// Gives a sphere that leaves its neighbourhood at `now` \[s\] another one, and looks for what it may
/// meet there.
pub(super) fn relocate(timeline: &mut Timeline, stage: &mut Stage, slot: u32, now: f64) {
    let state = timeline.state_of(slot, now);
    let around = &mut stage.around[0];
    timeline.relocate(slot, state.into(), &mut around.near);
    let mut ahead = timeline.outlooks[slot as usize].ahead;
    around.look_at_found(timeline, slot, now, (slot, 0.0));
    let found = around.first_meetings(timeline, slot);
    ahead.add(found.first);
    ahead.add(found.second);
    let outlook = outlook_after(timeline, stage.system, slot, ahead, now);
    timeline.schedule(slot, outlook);
}

/// Adds the surfaces near it that a sphere meets to what lies ahead of it.
fn meet_surfaces(
    timeline: &Timeline,
    system: &System,
    slot: u32,
    body: &Body,
    kind: &Kind,
    ahead: &mut Ahead,
) {
    let (horizon, flight_end) = (timeline.horizon(), timeline.flight_end(kind));
    let reach = (flight_end < f64::INFINITY)
        .then(|| Reach::of(body.flight(kind), kind.radius, flight_end - body.time));
    for (number, shift) in timeline.surfaces_near(slot) {
        let surface = &system.surfaces[number as usize];
        let is_at_rest = surface.motion.is_at_rest();
        let is_missed = |reach: Reach| reach.misses(&surface.form, shift);
        if is_at_rest && reach.is_some_and(is_missed) {
            continue;
        }
        if timeline.is_held_by(slot, number) {
            continue;
        }
        // A surface that moves is given as it is at the start of the frame.
        let start = if is_at_rest { body.time } else { body.time.max(timeline.frame[0]) };
        let (form, motion) = surface.after(start - timeline.frame[0]);
        let mut flight = body.flight_from(kind, start);
        flight.position -= shift;
        let turns = motion.angular_velocity != DVec3::ZERO;
        // Where a turning surface will be is known until the end of the frame.
        let until = if turns { timeline.frame[1] } else { horizon };
        let delay =
            contact_time::sphere_surface(&flight, kind.radius, &form, &motion, until - start);
        if let Some(delay) = delay {
            let target = Target::surface(number);
            ahead.add(Event { time: start + delay, target, flights: 0 });
        }
    }
}
