//! Meetings with surfaces that move. They are known up to the end of the frame, since the motion of a collider may
//! change from frame to frame.

use glam::DVec3;

use crate::contact_time::{self, Reach};
use crate::detect::contact::Bodies;
use crate::detect::moving_surfaces::PlacedTree;
use crate::detect::swept_region::{PathBounds, SweptRegion};
use crate::moving_bounds::MovingBounds;
use crate::parallel;
use crate::rule::exact::events::{Event, NextEvents, PackedTarget};
use crate::rule::exact::moving_regions::Clear;
use crate::rule::exact::timeline::Timeline;
use crate::surface::LastCarriage;
use crate::system::System;

/// Number of surfaces of a collider near the way of a sphere above which parts of the way are looked at.
const MANY_SURFACES: usize = 8;
/// Largest number of parts of a way.
const MOST_PARTS: f64 = 32.0;

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
struct Mover<'a> {
    /// Tree as placed at the start of the frame.
    tree: PlacedTree<'a>,
    /// Where it may be within the frame.
    region: SweptRegion,
    /// How it moves within the frame.
    moving: MovingBounds,
}

/// The colliders that move in the frame.
fn movers<'a>(timeline: &Timeline, system: &System<'a>) -> Vec<Mover<'a>> {
    let (frame, length) = (timeline.frame, timeline.frame[1] - timeline.frame[0]);
    let mover = |(number, tree): (usize, PlacedTree<'a>)| {
        let region = *timeline.moving_regions.of(number, frame);
        Mover { tree, region, moving: tree.moving(length) }
    };
    system.moving_after(0.0, &LastCarriage::default()).enumerate().map(mover).collect()
}

/// Working memory: surfaces near a sphere, those near a part of its way, and where their collider was last.
#[derive(Default)]
struct Memory {
    near: Vec<u32>,
    near_part: Vec<u32>,
    last: LastCarriage,
}

/// Adds the meetings of all spheres with surfaces that move, within a frame that begins, to their next events.
pub(crate) fn meet_in_frame(timeline: &mut Timeline, system: &System) {
    let slots = slots_near_movers(timeline, system);
    let known = &*timeline;
    let movers = movers(known, system);
    let found = parallel::map(slots.len(), |memory: &mut Memory, number| {
        let slot = slots[number];
        let way = Way::of(known, slot)?;
        let before = known.schedule.next_events(slot);
        let mut events = before;
        meet((known, system), (slot, &way), &movers, &[], (&mut events, memory));
        (events != before).then_some(events)
    });
    for (slot, events) in slots.into_iter().zip(found) {
        if let Some(events) = events {
            timeline.reschedule(slot, events);
        }
    }
}

/// Returns the slots of the spheres outside zones that may meet surfaces that move within the frame, ascending, and
/// notes for how long others are clear.
fn slots_near_movers(timeline: &mut Timeline, system: &System) -> Vec<u32> {
    let count = timeline.flights.bodies.len();
    let mut clear = timeline.moving_regions.take_clear(count);
    let mut are_near = vec![false; count];
    let known = &*timeline;
    // In a periodic box a flight leaves the image that it is beside.
    let are_lasting = known.moving_regions.are_lasting() && !system.settings.boundary.is_periodic();
    parallel::fill((&mut clear, &mut are_near), |first, (clear, are_near)| {
        let bodies = &known.flights.bodies[first..first + clear.len()];
        let spheres = bodies.iter().zip(clear).zip(are_near);
        for (slot, ((body, clear), is_near)) in (first as u32..).zip(spheres) {
            if clear.holds(known.frame[1], body.generation) {
                continue;
            }
            let until = if are_lasting { clear_for_long(known, slot) } else { None };
            match until {
                Some(until) => *clear = Clear::until(until, body.generation),
                None => {
                    let way = Way::of(known, slot).filter(|_| !known.flights.is_stepped(slot));
                    *is_near = way.is_some_and(|way| way.meets_any(known));
                }
            }
        }
    });
    timeline.moving_regions.set_clear(clear);
    (0..).zip(are_near).filter(|&(_, is_near)| is_near).map(|(slot, _)| slot).collect()
}

/// Returns the end of the time \[s\], not before the end of the frame, for which a free sphere is clear of surfaces that
/// move for several frames.
fn clear_for_long(timeline: &Timeline, slot: u32) -> Option<f64> {
    let body = &timeline.flights.bodies[slot as usize];
    let species = &timeline.flights.species[body.species as usize];
    if species.is_curved || species.is_stepped || species.cluster.is_some() {
        return None;
    }
    let [start, end] = timeline.frame;
    let sought = timeline.moving_regions.sought_until(timeline.frame);
    let until = sought.min(timeline.flight_end(slot, species));
    if body.time > start || until < end {
        return None;
    }
    let flight = body.flight_from(species, start);
    let center = flight.position - timeline.neighbours.shift_from_box(slot);
    let path = PathBounds { center, way: flight.farthest(until - start), radius: species.radius };
    timeline.moving_regions.are_missed_for_long(&path).then_some(until)
}

/// Adds the meetings of a sphere with the surfaces that move, from `now` \[s\] on within the frame and its flight, to its
/// next events; those that it passes over do not count.
pub(crate) fn meet_near(
    (timeline, system): (&Timeline, &System),
    (slot, now): (u32, f64),
    passed: &[Bodies],
    events: &mut NextEvents,
) {
    let way = Way::of(timeline, slot).map(|way| Way { from: way.from.max(now), ..way });
    if let Some(way) = way.filter(|way| way.meets_any(timeline)) {
        let (movers, memory) = (movers(timeline, system), &mut Memory::default());
        meet((timeline, system), (slot, &way), &movers, passed, (events, memory));
    }
}

/// The way of a sphere within the frame and its flight.
struct Way {
    /// When it begins and ends, on the world's clock \[s\].
    times: [f64; 2],
    /// From when on meetings are sought \[s\].
    from: f64,
    bounds: PathBounds,
}

impl Way {
    /// The way of the sphere at a slot; `None` if its flight is over or begins later.
    #[inline]
    fn of(timeline: &Timeline, slot: u32) -> Option<Self> {
        let body = &timeline.flights.bodies[slot as usize];
        let species = &timeline.flights.species[body.species as usize];
        let flight_end = timeline.flight_end(slot, species);
        let times @ [start, until] =
            [body.time.max(timeline.frame[0]), timeline.frame[1].min(flight_end)];
        if until < start {
            return None;
        }
        let curve = if species.is_curved { timeline.flights.curve_of(slot) } else { None };
        let (center, way) = match curve {
            Some((flight, _)) => (body.position, flight.farthest()),
            None if species.is_curved => (body.position, DVec3::INFINITY),
            None => {
                let flight = body.flight_from(species, start);
                (flight.position, flight.farthest(until - start))
            }
        };
        let center = center - timeline.neighbours.shift_from_box(slot);
        let bounds = PathBounds { center, way, radius: species.radius };
        Some(Self { times, from: start, bounds })
    }

    /// From when on and until when meetings are sought: two events may be known before its end \[s\].
    fn until_known(&self, events: &NextEvents) -> [f64; 2] {
        let [_, until] = self.times;
        [self.from, until.min(events.known_until()).max(self.from)]
    }

    /// Whether it may meet any collider that moves.
    #[inline]
    fn meets_any(&self, timeline: &Timeline) -> bool {
        !timeline.moving_regions.are_missed(&self.bounds, timeline.frame)
    }
}

/// Adds the meetings of a sphere on its way with the surfaces of `movers` to its next events; those that it passes over
/// do not count.
fn meet(
    (timeline, system): (&Timeline, &System),
    (slot, way): (u32, &Way),
    movers: &[Mover],
    passed: &[Bodies],
    (events, memory): (&mut NextEvents, &mut Memory),
) {
    let shift = timeline.neighbours.shift_from_box(slot);
    let sphere = timeline.flights.index_of[slot as usize];
    for (number, mover) in movers.iter().enumerate() {
        if way.bounds.misses(&mover.region) {
            continue;
        }
        let [start, until] = way.until_known(events);
        let (reach, begun) = timeline.flights.reach_within(slot, [start, until]);
        let (reach, since) = (reach.shifted(-shift), begun - timeline.frame[0]);
        let reach = reach.seen_from_moving(since, mover.tree.origin, &mover.moving);
        let Memory { near, last, .. } = &mut *memory;
        near.clear();
        mover.tree.add_near(reach.center(), reach.farthest(), near);
        near.retain(|&it| {
            let is_passed = passed.contains(&Bodies::Surface { sphere, surface: it });
            !reach.misses(&system.surfaces[it as usize].form, DVec3::ZERO)
                && !is_passed
                && timeline.neighbours.meets_surface(slot, it)
                && !timeline.flights.is_held_by(slot, it)
        });
        near.sort_unstable();
        if near.len() > MANY_SURFACES {
            meet_in_parts((timeline, system), (slot, way), (number, &reach), (events, memory));
            continue;
        }
        for &surface in near.iter() {
            let time = meeting(timeline, system, (slot, surface), way.times, last);
            if let Some(time) = time {
                events.add(Event::at(time, PackedTarget::surface(surface)));
            }
        }
    }
}

/// Adds the meetings of a sphere on its way with those surfaces of a mover, by its number, that are near in memory:
/// only with those that it comes near in a part of the way, in which surfaces and sphere move by about its radius, and
/// only up to the part at whose start two events are known. `whole` is the reach over all of the way.
fn meet_in_parts(
    (timeline, system): (&Timeline, &System),
    (slot, way): (u32, &Way),
    (number, whole): (usize, &Reach),
    (events, memory): (&mut NextEvents, &mut Memory),
) {
    let Memory { near, near_part, last } = memory;
    let shift = timeline.neighbours.shift_from_box(slot);
    let parts = (whole.farthest() / way.bounds.radius).clamp(1.0, MOST_PARTS) as u32;
    let [start, until] = way.until_known(events);
    let length = (until - start) / f64::from(parts);
    for part in 0..parts {
        let from = start + f64::from(part) * length;
        if from > events.known_until() || near.is_empty() {
            break;
        }
        let since = from - timeline.frame[0];
        let Some(tree) = system.moving_after(since, last).nth(number) else { continue };
        let [way_of_mover, spin] = tree.farthest([since, length]);
        let angle = spin * length;
        let moving = MovingBounds { way: way_of_mover, angle, ..MovingBounds::UNKNOWN };
        let reach = timeline.flights.reach_between(slot, [from, from + length]);
        let reach = reach.shifted(-shift).seen_from_moving(0.0, tree.origin, &moving);
        near_part.clear();
        tree.add_near(reach.center(), reach.farthest(), near_part);
        near_part.sort_unstable();
        near.retain(|surface| {
            let is_here = near_part.binary_search(surface).is_ok();
            if is_here {
                let time = meeting(timeline, system, (slot, *surface), way.times, last);
                if let Some(time) = time {
                    events.add(Event::at(time, PackedTarget::surface(*surface)));
                }
            }
            !is_here
        });
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
        let length = until - start;
        let moving = MovingBounds::within(length, motion.velocity, &course.bounds(0.0, length));
        let (reach, begun) = timeline.flights.reach_within(slot, [start, until]);
        let reach = reach.shifted(-shift).seen_from_moving(begun - start, motion.origin, &moving);
        if reach.misses(&form, DVec3::ZERO) {
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
