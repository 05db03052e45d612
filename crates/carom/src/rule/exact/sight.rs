//! What a sphere sees of others that fly alike: how near they are, and which of them it meets first.
//!
//! Several are looked at side by side, one in each lane of the processor's vectors. Every operation is
//! the one that a single one would need, so no bit depends on how many a processor takes at once.

use std::array;

use fearless_simd::{Level, Simd, SimdMask, dispatch, mask64x4};
use glam::DVec3;

use super::body::{Body, Kind};
use super::flights::{Flights, Relative};
use super::neighbour::Neighbour;
use super::neighbours::Images;
use super::timeline::Timeline;
use crate::contact_time::{self, Approach};
use crate::lanes::{LANES, Lanes};
use crate::norm::Norm;
use crate::real::{Real, Vector};

/// Relative rounding of the places and of the speeds of two spheres that touch.
const TOUCH_ROUNDING: f64 = 64.0 * f64::EPSILON;
/// Only within this part of the distance of centres may spheres be taken to touch.
const NEARLY_TOUCHING: f64 = 1e-6;

/// A look of a sphere at those near it.
#[derive(Clone, Copy)]
pub(super) struct Look<'a> {
    pub timeline: &'a Timeline,
    pub slot: u32,
    /// Those near it, and in the last lanes perhaps others.
    pub near: &'a [[Neighbour; LANES]],
    /// How many are near it.
    pub count: usize,
    /// Whether images may be among them, if they are from a list.
    pub has_images: bool,
    /// When it looks, on the world's clock \[s\]: at a time when all are in their neighbourhoods.
    pub now: f64,
    /// A sphere that may touch, and the part of the sum of radii up to which others do.
    pub besides: (u32, f64),
}

/// What a look has shown.
#[derive(Debug, Clone, Copy)]
pub(super) struct Seen {
    /// Whether one touches that may not.
    pub touches: bool,
    /// The first two meetings, on the world's clock \[s\], and the slots of those who are met;
    /// infinite if there are none.
    pub meetings: [(f64, u32); 2],
}

impl Look<'_> {
    /// Looks at all of those who fly alike.
    pub fn at_all(&self) -> Seen {
        let level = Level::new();
        let only_kind = self.timeline.only_kind();
        let falls = only_kind.map(|kind| kind.acceleration != DVec3::ZERO);
        let neighbours = &self.timeline.neighbours;
        macro_rules! look {
            ($($asked:ident),*) => {
                dispatch!(level, simd => View::<{ 0 $(| $asked)* }>::of(self).seen(simd))
            };
        }
        match (falls, neighbours.finds_itself(), neighbours.images()) {
            (Some(false), false, _) if !self.has_images => look!(),
            (Some(false), false, Images::ByPlace) => look!(NEAREST),
            (Some(false), true, Images::ByPlace) => look!(NEAREST, ITSELF),
            (Some(false), true, Images::None) => look!(ITSELF),
            (Some(false), ..) => look!(IMAGES, ITSELF),
            (Some(true), ..) => look!(IMAGES, ITSELF, FALLS),
            (None, ..) => look!(IMAGES, ITSELF, FALLS, KINDS),
        }
    }
}

/// A look at four.
struct Glance<S: Simd> {
    /// When they are met, on the world's clock \[s\]; infinite if never.
    time: Lanes<S>,
    /// Who is so near that it may touch.
    is_near: mask64x4<S>,
}

/// What has to be asked for each that a sphere looks at: whether it is an image, that sphere itself,
/// falls, or is of another kind.
const IMAGES: u8 = 1;
const ITSELF: u8 = 2;
const FALLS: u8 = 4;
const KINDS: u8 = 8;
/// Whether it is an image is told by its place, of those that do not fall.
const NEAREST: u8 = 16;

/// A look, where only the `ASKED` has to be asked for each.
struct View<'a, const ASKED: u8> {
    look: &'a Look<'a>,
    body: &'a Body,
    kind: &'a Kind,
    /// Where the sphere is now \[m\], if it flies straight.
    here: DVec3,
}

impl<'a, const ASKED: u8> View<'a, ASKED> {
    #[inline(always)]
    fn of(look: &'a Look<'a>) -> Self {
        let body = &look.timeline.bodies[look.slot as usize];
        let here = body.position + (look.now - body.time) * body.velocity;
        Self { look, body, kind: &look.timeline.kinds[body.kind as usize], here }
    }

    #[inline(always)]
    fn kind_of(&self, other: &Body) -> &Kind {
        if asks::<ASKED>(KINDS) {
            &self.look.timeline.kinds[other.kind as usize]
        } else {
            self.kind
        }
    }

    #[inline(always)]
    fn seen<S: Simd>(&self, simd: S) -> Seen {
        let Look { near, count, besides, .. } = *self.look;
        let all = |number: f64| Lanes::all(simd, number);
        let mut number = Lanes::each(simd, array::from_fn(|lane| lane as f64));
        let mut firsts = FirstTwo { times: [all(f64::INFINITY); 2], numbers: [all(0.0); 2] };
        let (mut touching, mut toucher) = (all(0.0), all(0.0));
        for four in near {
            let mut is_there = number.is_less(all(count as f64));
            if asks::<ASKED>(ITSELF) {
                let slots = Lanes::each(simd, four.map(Neighbour::slot_in_numbers));
                is_there &= !slots.is_equal(all(f64::from(self.look.slot)));
            }
            let Glance { time, is_near } = self.glance(simd, four, is_there);
            touching = touching + all(1.0).where_chosen(is_near, all(0.0));
            toucher = number.where_chosen(is_near, toucher);
            firsts = firsts.with(time, number);
            number = number + all(LANES as f64);
        }
        let slot_of = |number: f64| {
            let neighbour = near.as_flattened().get(number as u32 as usize);
            neighbour.map_or(0, |neighbour| neighbour.slot())
        };
        let touching: f64 = touching.to_array().iter().sum();
        // If there is one alone, all other lanes are zero.
        let toucher: f64 = toucher.to_array().iter().sum();
        Seen {
            touches: touching > 1.0 || (touching == 1.0 && slot_of(toucher) != besides.0),
            meetings: firsts.of_all_lanes().map(|(time, number)| (time, slot_of(number))),
        }
    }

    /// Looks at four, of whom only some may be there.
    #[inline(always)]
    fn glance<S: Simd>(
        &self,
        simd: S,
        four: &[Neighbour; LANES],
        is_there: mask64x4<S>,
    ) -> Glance<S> {
        let Self { look: Look { timeline, slot, besides, now, .. }, body, kind, here } = self;
        let all = |number: f64| Lanes::all(simd, number);
        let me = Flights {
            position: Vector::all(simd, body.position),
            velocity: Vector::all(simd, body.velocity),
            time: all(body.time),
        };
        let others = four.each_ref().map(|one| &timeline.bodies[one.slot() as usize]);
        let flights = Flights::of_each(simd, others);
        let way = if asks::<ASKED>(NEAREST) {
            let there = flights.position + flights.velocity * (all(*now) - flights.time);
            Some(timeline.neighbours.shifts_to_nearest(simd, there - Vector::all(simd, *here)))
        } else {
            asks::<ASKED>(IMAGES).then(|| timeline.neighbours.shifts_of(simd, *slot, four))
        };
        let acceleration = asks::<ASKED>(FALLS).then(|| Vector::all(simd, kind.acceleration));
        let Relative { start, offset, velocity } = me.see(&flights, way, acceleration);
        let (mut radius_sum, mut is_alike) = (all(kind.radius + kind.radius), is_there);
        if asks::<ASKED>(KINDS) {
            let kinds = others.map(|other| self.kind_of(other));
            radius_sum = all(kind.radius) + Lanes::each(simd, kinds.map(|kind| kind.radius));
            let alike = kinds.map(|other| f64::from(kind.flies_like(other)));
            is_alike = is_there & all(0.0).is_less(Lanes::each(simd, alike));
        }
        let approach = Approach::of(offset, velocity, radius_sum);
        let comes = approach.closing.is_less(all(0.0));
        let meets = is_alike & comes & all(0.0).is_at_most(approach.discriminant);
        let distance_squared = offset.length_squared();
        let distance = distance_squared.square_root();
        // For all of them: to ask whether one is met takes longer, for no processor can foresee it.
        let delay = approach.time(distance - radius_sum, distance + radius_sum);
        let mut time = (start + delay).where_chosen(meets, all(f64::INFINITY));
        let square = radius_sum * radius_sum;
        let is_close = meets & (distance_squared - square).is_at_most(square * NEARLY_TOUCHING);
        if is_close.any_true() {
            let times = self.close_meetings(four, time.to_array(), is_close.to_bitmask());
            time = Lanes::each(simd, times);
        }
        let reach = radius_sum * (1.0 + besides.1);
        Glance { time, is_near: is_alike & distance_squared.is_at_most(reach * reach) }
    }

    /// Puts the times \[s\] of those who nearly touch, given by bits, in their place.
    #[cold]
    #[inline(never)]
    fn close_meetings(
        &self,
        four: &[Neighbour; LANES],
        mut times: [f64; LANES],
        bits: u64,
    ) -> [f64; LANES] {
        for lane in (0..LANES).filter(|lane| bits >> lane & 1 == 1) {
            times[lane] = self.close_meeting(four[lane]);
        }
        times
    }

    /// When one is met that nearly touches, on the world's clock \[s\]; infinite if never.
    fn close_meeting(&self, near: Neighbour) -> f64 {
        let other = &self.look.timeline.bodies[near.slot() as usize];
        let [me, they] = [self.body, other].map(Flights::of_one);
        let shift = || self.look.timeline.neighbours.shift_of(self.look.slot, near).into();
        let way = asks::<ASKED>(IMAGES | NEAREST).then(shift);
        let acceleration = asks::<ASKED>(FALLS).then(|| self.kind.acceleration.into());
        let Relative { start, offset, velocity } = me.see(&they, way, acceleration);
        let (offset, velocity) = (offset.into(), velocity.into());
        let radius_sum = self.kind.radius + self.kind_of(other).radius;
        if only_touch([self.body, other], start, [offset, velocity], radius_sum) {
            return f64::INFINITY;
        }
        match contact_time::sphere_sphere_linear(offset, velocity, radius_sum) {
            Some(delay) => start + delay,
            None => f64::INFINITY,
        }
    }
}

#[inline(always)]
const fn asks<const ASKED: u8>(what: u8) -> bool {
    ASKED & what != 0
}

/// In each lane, the first two of some times, and the numbers that go with them.
#[derive(Clone, Copy)]
struct FirstTwo<S: Simd> {
    times: [Lanes<S>; 2],
    numbers: [Lanes<S>; 2],
}

impl<S: Simd> FirstTwo<S> {
    #[inline(always)]
    fn with(self, time: Lanes<S>, number: Lanes<S>) -> Self {
        let [first, second] = self.times;
        let [first_number, second_number] = self.numbers;
        let is_first = time.is_less(first);
        let later = first.where_chosen(is_first, time);
        let later_number = first_number.where_chosen(is_first, number);
        let is_second = later.is_less(second);
        Self {
            times: [time.where_chosen(is_first, first), later.where_chosen(is_second, second)],
            numbers: [
                number.where_chosen(is_first, first_number),
                later_number.where_chosen(is_second, second_number),
            ],
        }
    }

    /// Of all lanes.
    #[inline(always)]
    fn of_all_lanes(self) -> [(f64, f64); 2] {
        let halves = self.joined(self.rotated::<2>());
        let Self { times, numbers } = halves.joined(halves.rotated::<1>());
        [(times[0].first(), numbers[0].first()), (times[1].first(), numbers[1].first())]
    }

    #[inline(always)]
    fn joined(self, Self { times, numbers }: Self) -> Self {
        self.with(times[0], numbers[0]).with(times[1], numbers[1])
    }

    #[inline(always)]
    fn rotated<const BY: usize>(self) -> Self {
        Self {
            times: [self.times[0].rotated::<BY>(), self.times[1].rotated::<BY>()],
            numbers: [self.numbers[0].rotated::<BY>(), self.numbers[1].rotated::<BY>()],
        }
    }
}

/// Whether two spheres touch or overlap a little, and close by no more than the rounding of their
/// speeds, where one sees the other in this place \[m\] with this velocity \[m/s\] at `start` \[s\].
fn only_touch(
    bodies: [&Body; 2],
    start: f64,
    [offset, velocity]: [DVec3; 2],
    radius_sum: f64,
) -> bool {
    let gap = offset.length_squared() - radius_sum * radius_sum;
    let speed: f64 = bodies.iter().map(|body| body.velocity.norm()).sum();
    let place: f64 = bodies.iter().map(|body| body.position.norm()).sum();
    // How far they move in the rounding of the clock is in doubt, too.
    let size = radius_sum + place + speed * start.abs();
    gap.abs() <= NEARLY_TOUCHING * radius_sum * radius_sum
        && gap <= TOUCH_ROUNDING * radius_sum * size
        && -offset.dot(velocity) <= TOUCH_ROUNDING * radius_sum * speed
}
