//! What a sphere sees around it: how far its neighbours are, and which of them it meets first.

use std::hint::select_unpredictable;

use glam::DVec3;

use super::body::{Body, Kind, read_at_once};
use super::neighbour::Neighbour;
use super::outlook::{Ahead, Event, Target};
use super::timeline::Timeline;
use super::vicinity::{Vicinity, are_in_same_box};
use crate::contact_time;
use crate::detect::contact::Bodies;
use crate::norm::Norm;

/// Relative rounding of the places and of the speeds of two spheres that touch.
const TOUCH_ROUNDING: f64 = 64.0 * f64::EPSILON;
/// Only within this part of the distance of centres may spheres be taken to touch.
const NEARLY_TOUCHING: f64 = 1e-6;
/// Relative margin by which spheres have to pass each other to be left out: far more than rounding.
const PASSING_MARGIN: f64 = 1e-12;

/// Who is near a sphere, and whom of them it may meet.
#[derive(Debug, Clone, Default)]
pub(super) struct Surroundings {
    pub near: Vicinity,
    /// Those whom it may meet; what lies behind `count` has no meaning.
    closing: Vec<Closing>,
    count: usize,
}

/// A sphere that another may meet.
#[derive(Debug, Clone, Copy)]
struct Closing {
    neighbour: Neighbour,
    /// From the other one, as if both flew alike \[m\].
    offset: DVec3,
}

/// Two spheres that fly alike, as one of them sees the other. Under an acceleration both fall alike;
/// that this need not be asked for each neighbour is what `FALLS` is for.
struct Pair<'a, const FALLS: bool> {
    bodies: [&'a Body; 2],
    /// Of both \[m/s²\]; zero unless `FALLS`.
    acceleration: DVec3,
    /// Start of one of their flights, and not before that of the other, on the world's clock \[s\].
    start: f64,
}

impl<const FALLS: bool> Pair<'_, FALLS> {
    /// From the centre of the first sphere to that of the second, at the start \[m\]. Between the
    /// starts of their flights it is `shifted`, where an image is meant.
    #[inline(always)]
    fn offset(&self, shifted: impl Fn(DVec3) -> DVec3) -> DVec3 {
        let [a, b] = self.bodies;
        let [age_a, age_b] = [self.start - a.time, self.start - b.time];
        let offset = shifted(b.position - a.position) + (age_b * b.velocity - age_a * a.velocity);
        if FALLS {
            offset + (0.5 * (age_b * age_b - age_a * age_a)) * self.acceleration
        } else {
            offset
        }
    }

    /// Velocity of the second sphere seen from the first at the start \[m/s\].
    #[inline(always)]
    fn velocity(&self) -> DVec3 {
        let [a, b] = self.bodies;
        let velocity = b.velocity - a.velocity;
        if FALLS {
            velocity + ((self.start - b.time) - (self.start - a.time)) * self.acceleration
        } else {
            velocity
        }
    }

    /// When they meet, on the world's clock \[s\]; infinite if they never do. Each sees the other move
    /// in a straight line at constant speed.
    #[inline(always)]
    fn meeting(&self, offset: DVec3, radius_sum: f64) -> f64 {
        let velocity = self.velocity();
        let gap = offset.length_squared() - radius_sum * radius_sum;
        if gap.abs() <= NEARLY_TOUCHING * radius_sum * radius_sum
            && self.only_touch(offset, velocity, gap, radius_sum)
        {
            return f64::INFINITY;
        }
        match contact_time::sphere_sphere_linear(offset, velocity, radius_sum) {
            Some(delay) => self.start + delay,
            None => f64::INFINITY,
        }
    }

    /// Whether two spheres touch or overlap, and close by no more than the rounding of their speeds.
    #[inline(never)]
    fn only_touch(&self, offset: DVec3, velocity: DVec3, gap: f64, radius_sum: f64) -> bool {
        let speed: f64 = self.bodies.iter().map(|body| body.velocity.norm()).sum();
        let place: f64 = self.bodies.iter().map(|body| body.position.norm()).sum();
        // How far they move in the rounding of the clock is in doubt, too.
        let size = radius_sum + place + speed * self.start.abs();
        gap <= TOUCH_ROUNDING * radius_sum * size
            && -offset.dot(velocity) <= TOUCH_ROUNDING * radius_sum * speed
    }
}

impl Surroundings {
    /// Looks for those near it whom a sphere may meet, at the start of a flight of either that
    /// `start_with` gives \[s\]. Tells whether one of those that fly alike, but `other`, is nearer to
    /// it than the sum of their radii and `part` of it.
    #[inline(always)]
    pub fn look(
        &mut self,
        timeline: &Timeline,
        slot: u32,
        start_with: impl Fn(&Body) -> f64,
        besides: (u32, f64),
    ) -> bool {
        timeline.neighbours.find(slot, timeline.kind_of(slot).level, &mut self.near);
        self.look_at_found(timeline, slot, start_with, besides)
    }

    /// Likewise among those who were found already.
    #[inline(always)]
    pub fn look_at_found(
        &mut self,
        timeline: &Timeline,
        slot: u32,
        start_with: impl Fn(&Body) -> f64,
        besides: (u32, f64),
    ) -> bool {
        let kind = *timeline.kind_of(slot);
        if timeline.all_fly_alike() {
            let alike = |_: &Body| (true, kind.radius);
            return if kind.acceleration == DVec3::ZERO {
                self.look_at_all::<false>(timeline, slot, start_with, alike, besides)
            } else {
                self.look_at_all::<true>(timeline, slot, start_with, alike, besides)
            };
        }
        let is_alike = |other: &Body| {
            let other = &timeline.kinds[other.kind as usize];
            (kind.flies_like(other), other.radius)
        };
        self.look_at_all::<true>(timeline, slot, start_with, is_alike, besides)
    }

    #[inline(always)]
    fn look_at_all<const FALLS: bool>(
        &mut self,
        timeline: &Timeline,
        slot: u32,
        start_with: impl Fn(&Body) -> f64,
        is_alike: impl Fn(&Body) -> (bool, f64),
        besides: (u32, f64),
    ) -> bool {
        let Self { near, closing, count } = self;
        let near = timeline.neighbours.found(slot, near);
        if timeline.are_many() {
            read_at_once(&timeline.bodies, near.iter().map(|near| near.slot()));
        }
        if closing.len() < near.len() {
            let nobody = Neighbour::in_same_box(slot);
            closing.resize(near.len(), Closing { neighbour: nobody, offset: DVec3::ZERO });
        }
        let look = Look::<FALLS, _, _> { timeline, slot, start_with, is_alike, besides };
        let closing = &mut closing[..near.len()];
        let Seen { count: found, touches } = if are_in_same_box(near) {
            look.at(near, |_, offset| offset, closing)
        } else {
            let shifted = |other, offset| offset + timeline.neighbours.shift_of(slot, other);
            look.at(near, shifted, closing)
        };
        *count = found;
        touches
    }

    /// Whether one of the spheres that fly differently, but `other`, is nearer to the sphere than the
    /// sum of their radii and `part` of it, when its flight begins.
    pub fn touches_others(
        &self,
        timeline: &Timeline,
        slot: u32,
        (other, part): (u32, f64),
    ) -> bool {
        let (body, kind) = (&timeline.bodies[slot as usize], timeline.kind_of(slot));
        let mut near = timeline.neighbours.found(slot, &self.near).iter();
        near.any(|&near| {
            near.slot() != other
                && !timeline.kind_of(near.slot()).flies_like(kind)
                && is_near(timeline, slot, near, (body.position, body.time), part)
        })
    }

    /// Looks for those near a sphere that is at `place` \[m\] at `time` \[s\]. Tells whether one of them
    /// is nearer to it than the sum of their radii and `part` of it.
    pub fn touches_any(
        &mut self,
        timeline: &Timeline,
        slot: u32,
        place: (DVec3, f64),
        part: f64,
    ) -> bool {
        timeline.neighbours.find(slot, timeline.kind_of(slot).level, &mut self.near);
        let mut near = timeline.neighbours.found(slot, &self.near).iter();
        near.any(|&near| is_near(timeline, slot, near, place, part))
    }

    /// Adds the first two meetings with those to what lies ahead of the sphere.
    #[inline(always)]
    pub fn first_meetings(
        &self,
        timeline: &Timeline,
        slot: u32,
        start_with: impl Fn(&Body) -> f64,
        ahead: &mut Ahead,
    ) {
        let falls = timeline.kind_of(slot).acceleration != DVec3::ZERO;
        match (timeline.all_fly_alike(), falls) {
            (true, false) => {
                self.first_meetings_of::<true, false>(timeline, slot, start_with, ahead);
            }
            (true, true) => {
                self.first_meetings_of::<true, true>(timeline, slot, start_with, ahead);
            }
            (false, false) => {
                self.first_meetings_of::<false, false>(timeline, slot, start_with, ahead);
            }
            (false, true) => {
                self.first_meetings_of::<false, true>(timeline, slot, start_with, ahead);
            }
        }
    }

    #[inline(always)]
    fn first_meetings_of<const ALIKE: bool, const FALLS: bool>(
        &self,
        timeline: &Timeline,
        slot: u32,
        start_with: impl Fn(&Body) -> f64,
        ahead: &mut Ahead,
    ) {
        let Timeline { bodies, kinds, .. } = timeline;
        let body = &bodies[slot as usize];
        let kind = &kinds[body.kind as usize];
        let Kind { acceleration, radius, .. } = *kind;
        let [mut first, mut second] = [(f64::INFINITY, 0); 2];
        let closing = &self.closing[..self.count];
        for (number, one) in closing.iter().enumerate() {
            let other = &bodies[one.neighbour.slot() as usize];
            let other_kind = if ALIKE { kind } else { &kinds[other.kind as usize] };
            let time = if ALIKE || kind.flies_like(other_kind) {
                let start = start_with(other);
                let pair = Pair::<FALLS> { bodies: [body, other], acceleration, start };
                pair.meeting(one.offset, radius + other_kind.radius)
            } else {
                meeting_of_others(timeline, slot, one.neighbour)
            };
            // Without branches, likewise.
            let (is_first, is_second) = (time < first.0, time < second.0);
            let later = select_unpredictable(is_first, first, (time, number));
            second = select_unpredictable(is_second, later, second);
            first = select_unpredictable(is_first, (time, number), first);
        }
        for (time, number) in [first, second] {
            if time < f64::INFINITY {
                let other = closing[number].neighbour.slot();
                let flights = bodies[other as usize].flights;
                ahead.add(Event { time, target: Target::Sphere(other), flights });
            }
        }
    }
}

/// Whether a neighbour is nearer to a sphere than the sum of their radii and `part` of it, where that
/// is at `place` \[m\] at `time` \[s\].
fn is_near(
    timeline: &Timeline,
    slot: u32,
    neighbour: Neighbour,
    (place, time): (DVec3, f64),
    part: f64,
) -> bool {
    let shift = timeline.neighbours.shift_of(slot, neighbour);
    let offset = timeline.state_of(neighbour.slot(), time).0 + shift - place;
    let radius_sum = timeline.kind_of(slot).radius + timeline.kind_of(neighbour.slot()).radius;
    let reach = radius_sum * (1.0 + part);
    offset.length_squared() <= reach * reach
}

/// What a look has shown.
#[derive(Debug, Clone, Copy, Default)]
struct Seen {
    /// How many it may meet.
    count: usize,
    /// Whether one of them touches that may not.
    touches: bool,
}

/// How a sphere looks at those near it.
struct Look<'a, const FALLS: bool, S, A> {
    timeline: &'a Timeline,
    slot: u32,
    start_with: S,
    /// Tells of another one whether it flies alike, and its radius \[m\].
    is_alike: A,
    /// A sphere that may touch, and the part of the sum of radii up to which others do.
    besides: (u32, f64),
}

impl<const FALLS: bool, S, A> Look<'_, FALLS, S, A>
where
    S: Fn(&Body) -> f64,
    A: Fn(&Body) -> (bool, f64),
{
    /// Adds to those it may meet: of those that fly alike, the ones that come closer and do not pass
    /// by. Without branches on that, which no processor can foresee. The offsets of images are
    /// `shifted` \[m\].
    #[inline(always)]
    fn at(
        &self,
        near: &[Neighbour],
        shifted: impl Fn(Neighbour, DVec3) -> DVec3,
        found: &mut [Closing],
    ) -> Seen {
        let bodies = &self.timeline.bodies[..];
        let body = bodies[self.slot as usize];
        let Kind { acceleration, radius, .. } = *self.timeline.kind_of(self.slot);
        let (besides, part) = self.besides;
        let Seen { mut count, mut touches } = Seen::default();
        for &neighbour in near {
            let other = &bodies[neighbour.slot() as usize];
            let (is_alike, other_radius) = (self.is_alike)(other);
            let start = (self.start_with)(other);
            let pair = Pair::<FALLS> { bodies: [&body, other], acceleration, start };
            let offset = pair.offset(|offset| shifted(neighbour, offset));
            let velocity = pair.velocity();
            let radius_sum = radius + other_radius;
            let distance_squared = offset.length_squared();
            let closing = offset.dot(velocity);
            let gap = distance_squared * (1.0 - PASSING_MARGIN) - radius_sum * radius_sum;
            let meets = velocity.length_squared() * gap <= closing * closing;
            let reach = radius_sum * (1.0 + part);
            let is_near = (distance_squared <= reach * reach) & is_alike;
            touches |= is_near & (neighbour.slot() != besides);
            found[count] = Closing { neighbour, offset };
            count += usize::from(((closing < 0.0) & meets) | !is_alike);
        }
        Seen { count, touches }
    }
}

/// When a sphere meets one that flies differently, on the world's clock \[s\]; infinite if never.
fn meeting_of_others(timeline: &Timeline, slot: u32, neighbour: Neighbour) -> f64 {
    let slots = [slot, neighbour.slot()];
    let bodies = slots.map(|slot| &timeline.bodies[slot as usize]);
    let kinds = slots.map(|slot| timeline.kind_of(slot));
    let indices @ [index, other_index] = slots.map(|slot| timeline.index_of[slot as usize]);
    if timeline.has_lasted(Bodies::pair(indices)) {
        // No impact ends their flights.
        return f64::INFINITY;
    }
    let shift = timeline.neighbours.shift_of(slot, neighbour);
    if index < other_index {
        meeting(bodies, kinds, shift)
    } else {
        // In the order of ids: the other way round the same time might round differently.
        meeting([bodies[1], bodies[0]], [kinds[1], kinds[0]], -shift)
    }
}

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
