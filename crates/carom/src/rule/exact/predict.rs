//! What a sphere comes upon next.

use glam::DVec3;

use super::body::{Body, Kind};
use super::cells::Crossing;
use super::timeline::{Event, Surroundings, Target, Timeline};
use crate::contact_time;
use crate::detect::contact::Bodies;
use crate::system::System;

/// Predicts what a sphere meets next as of `now` \[s\], and notes it.
///
/// Times follow from the flights alone: whoever predicts a meeting, and whenever, finds the same
/// time to the bit.
pub(super) fn predict(timeline: &mut Timeline, system: &System, slot: u32, now: f64) {
    let body = timeline.bodies[slot as usize];
    let kind = timeline.kinds[body.kind as usize];
    let mut first = Event::NEVER;
    if system.settings.spheres_collide {
        let mut around = std::mem::take(&mut timeline.around[0]);
        timeline.cells.near(slot, kind.level, &mut around.near);
        meet_spheres(timeline, slot, &mut around, &mut first);
        timeline.around[0] = around;
    }
    meet_others(timeline, system, slot, &mut first);
    let crossing = timeline.cells.next_crossing(slot, &body, &kind, now);
    timeline.schedule(slot, first, crossing);
}

/// Likewise for a sphere whose flight begins now, when it is known who is near it, and how far it is
/// from its centre to theirs \[m\].
#[inline]
pub(super) fn predict_from(
    timeline: &mut Timeline,
    system: &System,
    slot: u32,
    around: &mut Surroundings,
    now: f64,
) {
    let body = timeline.bodies[slot as usize];
    let kind = timeline.kinds[body.kind as usize];
    let mut first = Event::NEVER;
    find_closing(timeline, slot, around, |_| now);
    meet_closing(timeline, slot, around, |_| now, &mut first);
    meet_others(timeline, system, slot, &mut first);
    let crossing = timeline.cells.next_crossing(slot, &body, &kind, now);
    timeline.schedule(slot, first, crossing);
}

/// Lets a sphere pass over a meeting that is due before `until` \[s\], to begin another flight then.
///
/// Two bodies that hardly touch may meet, by the rounding of one formula, and have nothing to
/// answer, by that of another. Whatever they are in doubt about is over within a contact's duration.
pub(super) fn pause(timeline: &mut Timeline, slot: u32, bodies: Bodies, until: f64) {
    let event = timeline.events[slot as usize];
    let sphere = timeline.index_of[slot as usize];
    let again = match event.target {
        Target::Sphere(other) => Bodies::pair([sphere, timeline.index_of[other as usize]]),
        Target::Surface(surface) => Bodies::Surface { sphere, surface },
        Target::Cluster | Target::Restart => return,
    };
    if again == bodies && event.time < until {
        timeline.reschedule(slot, Event { time: until, target: Target::Restart, flights: 0 });
    }
}

/// Begins another flight of a sphere from where it is at `now` \[s\].
pub(super) fn restart(timeline: &mut Timeline, system: &System, slot: u32, now: f64) {
    let (position, velocity) = timeline.state_of(slot, now);
    timeline.begin_flight(slot, position, velocity, now);
    predict(timeline, system, slot, now);
}

/// Puts a sphere that leaves its cell into the next one, and looks for what it may meet there.
pub(super) fn cross(timeline: &mut Timeline, system: &System, slot: u32, crossing: Crossing) {
    let Crossing { time, face } = crossing;
    let body = timeline.bodies[slot as usize];
    let kind = timeline.kinds[body.kind as usize];
    let mut first = timeline.events[slot as usize];
    if timeline.cells.cross(slot, &body, &kind, face, time) {
        if system.settings.spheres_collide {
            let mut around = std::mem::take(&mut timeline.around[0]);
            timeline.cells.near_beyond(slot, kind.level, face, &mut around.near);
            meet_spheres(timeline, slot, &mut around, &mut first);
            timeline.around[0] = around;
        }
        meet_surfaces(timeline, system, slot, &body, &kind, &mut first);
    }
    let crossing = timeline.cells.next_crossing(slot, &body, &kind, time);
    timeline.schedule(slot, first, crossing);
}

/// Puts what a sphere meets besides other spheres in the place of `first`, if it comes first.
pub(super) fn meet_others(timeline: &Timeline, system: &System, slot: u32, first: &mut Event) {
    let body = &timeline.bodies[slot as usize];
    let kind = &timeline.kinds[body.kind as usize];
    meet_surfaces(timeline, system, slot, body, kind, first);
    if let Some(cluster) = kind.cluster {
        let renewal = timeline.clusters.renewal_by(cluster, slot);
        if renewal < first.time {
            *first = Event { time: renewal, target: Target::Cluster, flights: 0 };
        }
    }
}

/// Likewise the first of the spheres near it that it meets.
#[inline]
fn meet_spheres(timeline: &Timeline, slot: u32, around: &mut Surroundings, first: &mut Event) {
    let Timeline { bodies, .. } = timeline;
    let body = &bodies[slot as usize];
    let acceleration = timeline.kind_of(slot).acceleration;
    let start_with = |other: &Body| body.time.max(other.time);
    measure(timeline, body, acceleration, around, start_with);
    find_closing(timeline, slot, around, start_with);
    meet_closing(timeline, slot, around, start_with, first);
}

/// Measures how far it is from a sphere to each of those near it \[m\], as if all flew alike, when
/// the later of their flights started.
#[inline(always)]
pub(super) fn measure(
    timeline: &Timeline,
    body: &Body,
    acceleration: DVec3,
    around: &mut Surroundings,
    start_with: impl Fn(&Body) -> f64,
) {
    let Surroundings { near, offsets, .. } = around;
    let offset = |slot: u32, shift: DVec3| {
        let other = &timeline.bodies[slot as usize];
        offset_of_alike([body, other], acceleration, shift, start_with(other))
    };
    offsets.clear();
    offsets.extend(near.in_same_box().iter().map(|&slot| offset(slot, DVec3::ZERO)));
    offsets.extend(near.images().iter().map(|&(slot, shift)| offset(slot, shift)));
}

/// Finds, of the spheres near it, those that a sphere may meet: of those that fly alike, the ones
/// that come closer and do not pass by. Without branches on that, which no processor can foresee.
#[inline(always)]
fn find_closing(
    timeline: &Timeline,
    slot: u32,
    around: &mut Surroundings,
    start_with: impl Fn(&Body) -> f64,
) {
    let Timeline { bodies, kinds, .. } = timeline;
    let body = &bodies[slot as usize];
    let kind = &kinds[body.kind as usize];
    let Surroundings { near, offsets, closing } = around;
    let may_meet = |other_slot: u32, offset: DVec3| {
        let other = &bodies[other_slot as usize];
        let other_kind = &kinds[other.kind as usize];
        let velocity = velocity_of_alike([body, other], kind.acceleration, start_with(other));
        let radius_sum = kind.radius + other_kind.radius;
        let across = offset.cross(velocity).length_squared();
        let meets = across <= velocity.length_squared() * (radius_sum * radius_sum);
        ((offset.dot(velocity) < 0.0) & meets) | !kind.flies_like(other_kind)
    };
    if closing.len() < offsets.len() {
        closing.resize(offsets.len(), 0);
    }
    let same_box = near.in_same_box();
    let mut count = 0;
    for (n, (&other, &offset)) in (0u32..).zip(same_box.iter().zip(offsets.iter())) {
        closing[count] = n;
        count += usize::from(may_meet(other, offset));
    }
    let first_image = same_box.len();
    for (n, (&(other, _), &offset)) in
        (first_image as u32..).zip(near.images().iter().zip(&offsets[first_image..]))
    {
        closing[count] = n;
        count += usize::from(may_meet(other, offset));
    }
    closing.truncate(count);
}

/// Puts the first meeting with one of those in the place of `first`, if it comes first.
#[inline(always)]
fn meet_closing(
    timeline: &Timeline,
    slot: u32,
    around: &Surroundings,
    start_with: impl Fn(&Body) -> f64,
    first: &mut Event,
) {
    let Timeline { bodies, kinds, .. } = timeline;
    let body = &bodies[slot as usize];
    let kind = &kinds[body.kind as usize];
    for &n in &around.closing {
        let (other_slot, shift) = around.near.nth(n as usize);
        let other = &bodies[other_slot as usize];
        let other_kind = &kinds[other.kind as usize];
        let time = if kind.flies_like(other_kind) {
            let offset = around.offsets[n as usize];
            let kinds = [kind, other_kind];
            meeting_of_alike([body, other], kinds, offset, start_with(other))
        } else if last_together(timeline, [slot, other_slot], [kind, other_kind]) {
            f64::INFINITY
        } else if timeline.index_of[slot as usize] < timeline.index_of[other_slot as usize] {
            meeting([body, other], [kind, other_kind], shift)
        } else {
            // In the order of ids: the other way round the same time might round differently.
            meeting([other, body], [other_kind, kind], -shift)
        };
        if time < first.time {
            let target = Target::Sphere(other_slot);
            *first = Event { time, target, flights: other.flights };
        }
    }
}

/// Whether two spheres are in lasting contact with each other: then no impact ends their flights.
fn last_together(timeline: &Timeline, slots: [u32; 2], kinds: [&Kind; 2]) -> bool {
    kinds[0].cluster.is_some_and(|cluster| {
        let pair = Bodies::pair(slots.map(|slot| timeline.index_of[slot as usize]));
        kinds[1].cluster == Some(cluster) && timeline.clusters.contains(cluster, pair)
    })
}

/// From the centre of the first sphere to that of the second, at `start` \[s\], which is the start
/// of one of their flights and not before that of the other \[m\]; of spheres that fly alike.
#[inline(always)]
pub(super) fn offset_of_alike(
    [a, b]: [&Body; 2],
    acceleration: DVec3,
    shift: DVec3,
    start: f64,
) -> DVec3 {
    let (age_a, age_b) = (start - a.time, start - b.time);
    let offset = b.position - a.position + shift + (age_b * b.velocity - age_a * a.velocity);
    if acceleration == DVec3::ZERO {
        return offset;
    }
    offset + (0.5 * (age_b * age_b - age_a * age_a)) * acceleration
}

/// Velocity \[m/s\] of the second sphere seen from the first at `start` \[s\]; of spheres that fly
/// alike.
#[inline(always)]
fn velocity_of_alike([a, b]: [&Body; 2], acceleration: DVec3, start: f64) -> DVec3 {
    let velocity = b.velocity - a.velocity;
    if acceleration == DVec3::ZERO {
        return velocity;
    }
    velocity + ((start - b.time) - (start - a.time)) * acceleration
}

/// When two spheres meet that fly alike, so that each sees the other move in a straight line at
/// constant speed, on the world's clock \[s\]; infinite if they never do. `offset` \[m\] is where the
/// second is seen from the first at `start` \[s\].
#[inline(always)]
fn meeting_of_alike([a, b]: [&Body; 2], kinds: [&Kind; 2], offset: DVec3, start: f64) -> f64 {
    let velocity = velocity_of_alike([a, b], kinds[0].acceleration, start);
    let radius_sum = kinds[0].radius + kinds[1].radius;
    let gap = offset.length_squared() - radius_sum * radius_sum;
    if gap.abs() <= TOUCH_ROUNDING * radius_sum * radius_sum {
        // Two that touch close only if they do so by more than the rounding of their speeds.
        let rounding = TOUCH_ROUNDING * radius_sum * (a.velocity.length() + b.velocity.length());
        if -offset.dot(velocity) <= rounding {
            return f64::INFINITY;
        }
    }
    match contact_time::sphere_sphere_linear(offset, velocity, radius_sum) {
        Some(delay) => start + delay,
        None => f64::INFINITY,
    }
}

/// Relative rounding of a distance and of a speed of two spheres that touch.
const TOUCH_ROUNDING: f64 = 64.0 * f64::EPSILON;

/// When two spheres meet that fly differently. Searched for without end: what is known already must
/// not change by a bit what is found.
fn meeting(bodies: [&Body; 2], kinds: [&Kind; 2], shift: DVec3) -> f64 {
    let start = bodies[0].time.max(bodies[1].time);
    let first = bodies[0].flight_from(kinds[0], start);
    let mut second = bodies[1].flight_from(kinds[1], start);
    second.position += shift;
    let radius_sum = kinds[0].radius + kinds[1].radius;
    match contact_time::sphere_sphere(&first, &second, radius_sum, f64::INFINITY) {
        Some(delay) => start + delay,
        None => f64::INFINITY,
    }
}

/// Likewise for surfaces.
fn meet_surfaces(
    timeline: &Timeline,
    system: &System,
    slot: u32,
    body: &Body,
    kind: &Kind,
    first: &mut Event,
) {
    for (number, shift) in timeline.surfaces_near(slot) {
        let lasts = kind.cluster.is_some_and(|cluster| {
            let sphere = timeline.index_of[slot as usize];
            let bodies = Bodies::Surface { sphere, surface: number };
            timeline.clusters.contains(cluster, bodies)
        });
        if lasts {
            continue;
        }
        let surface = &system.surfaces[number as usize];
        // A surface that moves is given as it is at the start of the frame.
        let start =
            if surface.motion.is_at_rest() { body.time } else { body.time.max(timeline.frame[0]) };
        let (form, motion) = surface.after(start - timeline.frame[0]);
        let mut flight = body.flight_from(kind, start);
        flight.position -= shift;
        let turns = motion.angular_velocity != DVec3::ZERO;
        // Where a turning surface will be is known until the end of the frame.
        let horizon = if turns { timeline.frame[1] - start } else { f64::INFINITY };
        let delay = contact_time::sphere_surface(&flight, kind.radius, &form, &motion, horizon);
        if let Some(delay) = delay
            && start + delay < first.time
        {
            let target = Target::Surface(number);
            *first = Event { time: start + delay, target, flights: 0 };
        }
    }
}
