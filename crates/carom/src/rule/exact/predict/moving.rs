//! Meetings with surfaces that move. They are known up to the end of the frame, since the motion of a collider may
//! change from frame to frame.

use glam::DVec3;

use crate::contact_time;
use crate::detect::contact::Bodies;
use crate::detect::moving_surfaces::PlacedTree;
use crate::norm::Norm;
use crate::parallel;
use crate::rule::exact::events::{Event, NextEvents, PackedTarget};
use crate::rule::exact::timeline::Timeline;
use crate::surface::LastCarriage;
use crate::system::System;

/// A place where a sphere may touch surfaces.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Around {
    /// \[m\]
    pub place: DVec3,
    /// Distance up to which surfaces count \[m\].
    pub reach: f64,
    /// Time on the world's clock \[s\].
    pub time: f64,
    /// How long surfaces move on from then \[s\].
    pub length: f64,
}

impl Around {
    /// Reach of a sphere that touches a surface, as a part of its radius: more than any rounding.
    const TOUCH: f64 = 2.0;

    /// Where a sphere with this centre and radius \[m\] touches surfaces at `time` \[s\].
    pub fn touching(place: DVec3, radius: f64, time: f64) -> Self {
        Self { place, reach: Self::TOUCH * radius, time, length: 0.0 }
    }

    /// Returns the search with a reach longer by a distance \[m\].
    pub fn farther(self, distance: f64) -> Self {
        Self { reach: self.reach + distance, ..self }
    }

    /// Returns the search over a time in which surfaces move on for a `length` \[s\].
    pub fn lasting(self, length: f64) -> Self {
        Self { length, ..self }
    }
}

/// The numbers of the surfaces that move and may be within reach of the sphere at `slot`, ascending.
pub(crate) fn near(
    timeline: &Timeline,
    system: &System,
    slot: u32,
    Around { place, reach, time, length }: Around,
    last: &LastCarriage,
) -> Vec<u32> {
    let mut near = Vec::new();
    let place = place - timeline.neighbours.shift_from_box(slot);
    let since = time - timeline.frame[0];
    for tree in system.moving_after(since, last) {
        let beside = match length > 0.0 {
            true => tree.way_beside(place, reach, [since, length]),
            false => 0.0,
        };
        tree.add_near(place, reach + beside, &mut near);
    }
    near.sort_unstable();
    near
}

/// The surfaces of a collider that moves.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Mover<'a> {
    /// Tree as placed at the start of the frame.
    tree: PlacedTree<'a>,
    /// How far its origin moves within the frame, at most \[m\].
    way: f64,
    /// How far it turns within the frame, at most \[rad\].
    angle: f64,
}

/// The colliders that move in the frame.
pub(crate) fn movers<'a>(timeline: &Timeline, system: &System<'a>) -> Vec<Mover<'a>> {
    let times @ [_, length] = [0.0, timeline.frame[1] - timeline.frame[0]];
    let mover = |tree: PlacedTree<'a>| {
        let [way, spin] = tree.farthest(times);
        Mover { tree, way, angle: spin * length }
    };
    system.moving_after(0.0, &LastCarriage::default()).map(mover).collect()
}

/// Working memory: surfaces near a sphere, and where their collider was last.
#[derive(Default)]
pub(crate) struct Memory {
    near: Vec<u32>,
    last: LastCarriage,
}

/// Adds the meetings of all spheres with surfaces that move, within a frame that begins, to their next events.
pub(crate) fn meet_in_frame(timeline: &mut Timeline, system: &System) {
    let known = &*timeline;
    let (count, movers) = (known.flights.bodies.len(), movers(known, system));
    let found: Vec<Option<NextEvents>> = parallel::map(count, |memory: &mut Memory, slot| {
        let slot = slot as u32;
        if known.flights.is_stepped(slot) {
            return None;
        }
        let before = known.schedule.next_events(slot);
        let mut events = before;
        meet((known, system), slot, &movers, &[], (&mut events, memory));
        (events != before).then_some(events)
    });
    for (slot, events) in (0..).zip(found) {
        if let Some(events) = events {
            timeline.reschedule(slot, events);
        }
    }
}

/// Adds the meetings of a sphere with the surfaces of `movers`, within the frame and its flight, to its next events;
/// those that it passes over do not count.
pub(crate) fn meet(
    (timeline, system): (&Timeline, &System),
    slot: u32,
    movers: &[Mover],
    passed: &[Bodies],
    (events, memory): (&mut NextEvents, &mut Memory),
) {
    let body = &timeline.flights.bodies[slot as usize];
    let species = &timeline.flights.species[body.species as usize];
    let flight_end = timeline.flight_end(slot, species);
    let (start, until) = (body.time.max(timeline.frame[0]), timeline.frame[1].min(flight_end));
    if until < start {
        return;
    }
    let end = if species.is_curved { flight_end } else { until };
    let reach = timeline.flights.reach_of(slot, end);
    let shift = timeline.neighbours.shift_from_box(slot);
    let place = body.position - shift;
    let sphere = timeline.flights.index_of[slot as usize];
    let Memory { near, last } = memory;
    for Mover { tree, way, angle } in movers {
        let reach = reach.seen_from_moving(*way, *angle, (place - tree.origin).norm());
        near.clear();
        tree.add_near(place, reach.farthest(), near);
        near.retain(|&it| {
            let is_passed = passed.contains(&Bodies::Surface { sphere, surface: it });
            !reach.misses(&system.surfaces[it as usize].form, shift)
                && !is_passed
                && timeline.neighbours.meets_surface(slot, it)
                && !timeline.flights.is_held_by(slot, it)
        });
        near.sort_unstable();
        for &surface in near.iter() {
            let time = meeting(timeline, system, (slot, surface), [start, until], last);
            if let Some(time) = time {
                events.add(Event::at(time, PackedTarget::surface(surface)));
            }
        }
    }
}

/// Returns when a sphere meets a surface that moves, between two times of the frame \[s\].
fn meeting(
    timeline: &Timeline,
    system: &System,
    (slot, number): (u32, u32),
    [start, until]: [f64; 2],
    last: &LastCarriage,
) -> Option<f64> {
    let body = &timeline.flights.bodies[slot as usize];
    let species = &timeline.flights.species[body.species as usize];
    let shift = timeline.neighbours.shift_from_box(slot);
    let flight_end = timeline.flight_end(slot, species);
    let surface = &system.surfaces[number as usize];
    let since = start - timeline.frame[0];
    let (form, motion) = last.after(surface, since);
    let course = surface.course_after(since);
    if let Some(course) = &course {
        let end = if species.is_curved { flight_end } else { until };
        let bounds = course.bounds(0.0, until - start);
        let arm = (body.position - shift - motion.origin).norm();
        let reach = timeline.flights.reach_of(slot, end);
        let reach = reach.seen_from_moving(bounds.way, bounds.spin * (until - start), arm);
        if reach.misses(&form, shift) {
            return None;
        }
    }
    let is_bounded = course.is_some() || motion.angular_velocity != DVec3::ZERO;
    // Where time has no bound, its root does not depend on when frames end.
    let horizon = if is_bounded { until } else { flight_end.min(timeline.horizon()) };
    let track = timeline.flights.track_from(slot, start).shifted(-shift);
    let (radius, horizon) = (species.radius, horizon - start);
    let delay =
        contact_time::track_surface(&track, radius, &form, &motion, course.as_ref(), horizon);
    delay.map(|delay| start + delay).filter(|&time| time <= until)
}
