//! The pair kernel: tests a sphere against the neighbours that fly alike, one in each lane of the processor's
//! vectors. Every operation is the one that a single pair needs, so the bits do not depend on the number of lanes.
//!
//! Every operation is the one that a single pair needs, so no bit depends on how many lanes a processor
//! has.

use std::array;

use fearless_simd::{Level, Simd, SimdMask, dispatch, mask64x4};
use glam::DVec3;

use super::relative::Relative;
use crate::contact_time::{self, Approach, GrowingApproach};
use crate::lanes::{LANES, Lanes};
use crate::norm::Norm;
use crate::real::{Real, Vector};
use crate::rule::exact::flights::{Body, FlightLanes, Species};
use crate::rule::exact::neighbours::{Images, Neighbour};
use crate::rule::exact::timeline::Timeline;

/// Relative rounding of the positions and of the speeds of two spheres that touch.
const TOUCH_ROUNDING: f64 = 64.0 * f64::EPSILON;
/// Only within this part of the distance of centres may spheres be taken to touch.
const NEARLY_TOUCHING: f64 = 1e-6;

/// A sphere and the neighbours against which it is tested.
#[derive(Clone, Copy)]
pub(super) struct PairQuery<'a> {
    pub timeline: &'a Timeline,
    pub slot: u32,
    /// The neighbours; other spheres may fill the last lanes.
    pub near: &'a [[Neighbour; LANES]],
    /// How many neighbours there are.
    pub count: usize,
    /// Whether images may be among them, if they are from a list.
    pub has_images: bool,
    /// A time on the world's clock \[s\] when all are in their neighbour regions.
    pub now: f64,
    /// A sphere that does not count as near.
    pub exempt: u32,
    /// Part of the sum of radii by which the gap to a sphere that is near may be open.
    pub margin: f64,
}

/// A meeting with another sphere.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Meeting {
    /// Time of the meeting on the world's clock \[s\]; infinite if there is none.
    pub time: f64,
    /// The slot of the other sphere.
    pub other: u32,
}

/// The result of a query.
#[derive(Debug, Clone, Copy)]
pub(super) struct PairResult {
    /// Whether a sphere other than the exempt one is near.
    pub is_near: bool,
    /// The first two meetings.
    pub meetings: [Meeting; 2],
}

impl PairQuery<'_> {
    /// Tests the neighbours that fly alike, by a kernel that is compiled for the cases that occur.
    pub fn result(&self) -> PairResult {
        let level = Level::new();
        let only_species = self.timeline.flights.only_species();
        let falls = only_species.map(|species| species.acceleration != DVec3::ZERO);
        let neighbours = &self.timeline.neighbours;
        macro_rules! run {
            ($($case:ident),*) => {
                dispatch!(level, simd => PairKernel::<{ 0 $(| $case)* }>::of(self).result(simd))
            };
        }
        let flights = &self.timeline.flights;
        if !flights.non_additivity.is_none() {
            return match (flights.growth, neighbours.images()) {
                (Some(_), _) => run!(IMAGES, ITSELF, SPECIES, GROWS, FACTORS),
                (None, Images::Sliding) => run!(IMAGES, ITSELF, SPECIES, SLIDES, FACTORS),
                _ => run!(IMAGES, ITSELF, FALLS, SPECIES, FACTORS),
            };
        }
        if flights.growth.is_some() {
            return run!(IMAGES, ITSELF, SPECIES, GROWS);
        }
        if flights.wells.is_some() {
            return run!(IMAGES, ITSELF, FALLS, SPECIES, WELLS);
        }
        match (falls, neighbours.finds_itself(), neighbours.images()) {
            (Some(false), false, _) if !self.has_images => run!(),
            (Some(false), false, Images::ByPlace) => run!(NEAREST),
            (Some(false), true, Images::ByPlace) => run!(NEAREST, ITSELF),
            (Some(false), true, Images::None) => run!(ITSELF),
            (_, _, Images::Sliding) => run!(IMAGES, ITSELF, SPECIES, SLIDES),
            (Some(false), ..) => run!(IMAGES, ITSELF),
            (Some(true), ..) => run!(IMAGES, ITSELF, FALLS),
            (None, ..) => run!(IMAGES, ITSELF, FALLS, SPECIES),
        }
    }
}

/// The result of a test of four neighbours.
struct LaneResult<S: Simd> {
    /// When the sphere meets each, on the world's clock \[s\]; infinite if never.
    time: Lanes<S>,
    /// The neighbours that are near.
    is_near: mask64x4<S>,
}

/// Cases of neighbours: an image, the sphere itself, falling, of another species.
const IMAGES: u16 = 1;
const ITSELF: u16 = 2;
const FALLS: u16 = 4;
const SPECIES: u16 = 8;
/// Images are recognised by the positions of their spheres, none of which falls.
const NEAREST: u16 = 16;
/// Radii grow.
const GROWS: u16 = 32;
/// Images slide, as those of a box in steady shear.
const SLIDES: u16 = 64;
/// There are wells around spheres.
const WELLS: u16 = 128;
/// Contact distances of species have factors.
const FACTORS: u16 = 256;

/// A query where only these `CASES` occur.
struct PairKernel<'a, const CASES: u16> {
    query: &'a PairQuery<'a>,
    body: &'a Body,
    species: &'a Species,
    /// Position of the sphere now \[m\], if it flies straight.
    here: DVec3,
}

impl<'a, const CASES: u16> PairKernel<'a, CASES> {
    #[inline(always)]
    fn of(query: &'a PairQuery<'a>) -> Self {
        let flights = &query.timeline.flights;
        let body = &flights.bodies[query.slot as usize];
        let here = body.position + (query.now - body.time) * body.velocity;
        Self { query, body, species: &flights.species[body.species as usize], here }
    }

    #[inline(always)]
    fn species_of(&self, other: &Body) -> &Species {
        if covers::<CASES>(SPECIES) {
            &self.query.timeline.flights.species[other.species as usize]
        } else {
            self.species
        }
    }

    #[inline(always)]
    fn result<S: Simd>(&self, simd: S) -> PairResult {
        let PairQuery { near, count, exempt, .. } = *self.query;
        let all = |number: f64| Lanes::all(simd, number);
        let mut number = Lanes::each(simd, array::from_fn(|lane| lane as f64));
        let mut firsts = FirstTwo { times: [all(f64::INFINITY); 2], numbers: [all(0.0); 2] };
        let (mut near_count, mut nearest) = (all(0.0), all(0.0));
        for four in near {
            let mut is_there = number.is_less(all(count as f64));
            if covers::<CASES>(ITSELF) {
                let slots = Lanes::each(simd, four.map(Neighbour::slot_in_numbers));
                is_there &= !slots.is_equal(all(f64::from(self.query.slot)));
            }
            let LaneResult { time, is_near } = self.test(simd, four, is_there);
            near_count = near_count + all(1.0).select(is_near, all(0.0));
            nearest = number.select(is_near, nearest);
            firsts = firsts.with(time, number);
            number = number + all(LANES as f64);
        }
        let slot_of = |number: f64| {
            let neighbour = near.as_flattened().get(number as u32 as usize);
            neighbour.map_or(0, |neighbour| neighbour.slot())
        };
        let near_count: f64 = near_count.to_array().iter().sum();
        // With a single one, all other lanes are zero.
        let nearest: f64 = nearest.to_array().iter().sum();
        PairResult {
            is_near: near_count > 1.0 || (near_count == 1.0 && slot_of(nearest) != exempt),
            meetings: firsts
                .of_all_lanes()
                .map(|(time, number)| Meeting { time, other: slot_of(number) }),
        }
    }

    /// Tests four entries, some of which may be unused.
    #[inline(always)]
    fn test<S: Simd>(
        &self,
        simd: S,
        four: &[Neighbour; LANES],
        is_there: mask64x4<S>,
    ) -> LaneResult<S> {
        let Self { query: PairQuery { timeline, slot, margin, now, .. }, body, species, here } =
            self;
        let all = |number: f64| Lanes::all(simd, number);
        let own = FlightLanes {
            position: Vector::all(simd, body.position),
            velocity: Vector::all(simd, body.velocity),
            time: all(body.time),
        };
        let others = four.each_ref().map(|one| &timeline.flights.bodies[one.slot() as usize]);
        let flights = FlightLanes::of_each(simd, others);
        let mut image_velocity = None;
        let image_shift = if covers::<CASES>(SLIDES) {
            let start = own.time.max(flights.time).to_array();
            let motions: [[DVec3; 2]; LANES] = array::from_fn(|lane| {
                timeline.neighbours.image_motion_of(*slot, four[lane], start[lane])
            });
            image_velocity = Some(Vector::each(simd, motions.map(|motion| motion[1])));
            Some(Vector::each(simd, motions.map(|motion| motion[0])))
        } else if covers::<CASES>(NEAREST) {
            let there = flights.position + flights.velocity * (all(*now) - flights.time);
            Some(timeline.neighbours.shifts_to_nearest(simd, there - Vector::all(simd, *here)))
        } else {
            covers::<CASES>(IMAGES).then(|| timeline.neighbours.shifts_of(simd, *slot, four))
        };
        let acceleration = covers::<CASES>(FALLS).then(|| Vector::all(simd, species.acceleration));
        let Relative { start, offset, mut velocity } =
            Relative::between(&own, &flights, image_shift, acceleration);
        if let Some(image_velocity) = image_velocity {
            velocity = velocity + image_velocity;
        }
        let (mut radius_sum, mut is_alike) = (all(species.radius + species.radius), is_there);
        if covers::<CASES>(SPECIES) {
            let theirs = others.map(|other| self.species_of(other));
            radius_sum = if covers::<CASES>(FACTORS) {
                let distance = |other| timeline.flights.contact_distance([*species, other]);
                Lanes::each(simd, theirs.map(distance))
            } else {
                all(species.radius) + Lanes::each(simd, theirs.map(|it| it.radius))
            };
            let alike = theirs.map(|other| f64::from(species.flies_like(other)));
            is_alike = is_there & all(0.0).is_less(Lanes::each(simd, alike));
        }
        if covers::<CASES>(GROWS) {
            let speeds = others.map(|other| self.growth_speed_with(self.species_of(other)));
            let growth_speed = Lanes::each(simd, speeds);
            let grown = Relative { start, offset, velocity };
            return self.test_growing(simd, four, is_alike, grown, [radius_sum, growth_speed]);
        }
        let approach = Approach::of(offset, velocity, radius_sum);
        let comes = approach.closing.is_less(all(0.0));
        let meets = is_alike & comes & all(0.0).is_at_most(approach.discriminant);
        let distance_squared = offset.length_squared();
        let distance = distance_squared.sqrt();
        // All lanes compute this: a branch that the processor cannot predict would take longer.
        let delay = approach.time(distance - radius_sum, distance + radius_sum);
        let mut time = (start + delay).select(meets, all(f64::INFINITY));
        let square = radius_sum * radius_sum;
        let is_close = if covers::<CASES>(WELLS) {
            is_alike
        } else {
            meets & (distance_squared - square).is_at_most(square * NEARLY_TOUCHING)
        };
        if is_close.any_true() {
            let times = self.close_meetings(four, time.to_array(), is_close.to_bitmask());
            time = Lanes::each(simd, times);
        }
        let reach = radius_sum * (1.0 + margin);
        LaneResult { time, is_near: is_alike & distance_squared.is_at_most(reach * reach) }
    }

    /// Tests four neighbours whose radii grow, for these sums of radii \[m\] and of growth speeds \[m/s\]. None
    /// counts as near, which impacts of growing spheres do not need.
    #[inline(always)]
    fn test_growing<S: Simd>(
        &self,
        simd: S,
        four: &[Neighbour; LANES],
        is_alike: mask64x4<S>,
        relative: Relative<Lanes<S>>,
        [radius_sum, growth_speed]: [Lanes<S>; 2],
    ) -> LaneResult<S> {
        let all = |number: f64| Lanes::all(simd, number);
        let Relative { start, offset, velocity } = relative;
        let radius_sum = radius_sum + growth_speed * (start - all(self.growing_since()));
        let approach = GrowingApproach::of(offset, velocity, radius_sum, growth_speed);
        let distance_squared = offset.length_squared();
        let distance = distance_squared.sqrt();
        let is_real = is_alike & all(0.0).is_at_most(approach.discriminant);
        let closes = is_real & approach.closing.is_less(all(0.0));
        let is_overtaken =
            is_real & all(0.0).is_at_most(approach.closing) & approach.curvature.is_less(all(0.0));
        let soon = approach.time(distance - radius_sum, distance + radius_sum);
        let late = start + approach.late_time();
        let mut time = (start + soon).select(closes, late.select(is_overtaken, all(f64::INFINITY)));
        let square = radius_sum * radius_sum;
        let is_close = is_alike & (distance_squared - square).is_at_most(square * NEARLY_TOUCHING);
        if is_close.any_true() {
            let times = self.close_meetings(four, time.to_array(), is_close.to_bitmask());
            time = Lanes::each(simd, times);
        }
        LaneResult { time, is_near: all(1.0).is_less(all(0.0)) }
    }

    /// Returns the speed at which the contact distance of the sphere and one of another species grows \[m/s\].
    #[inline(always)]
    fn growth_speed_with(&self, other: &Species) -> f64 {
        if covers::<CASES>(FACTORS) {
            let factor = self.query.timeline.flights.distance_factor([self.species, other]);
            return factor * self.species.growth_speed + factor * other.growth_speed;
        }
        self.species.growth_speed + other.growth_speed
    }

    /// Returns the time on the world's clock at which radii were those of the species \[s\].
    fn growing_since(&self) -> f64 {
        self.query.timeline.flights.growth.map_or(0.0, |growth| growth.since)
    }

    /// Replaces the times \[s\] of the neighbours with these bits, which nearly touch or have wells.
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

    /// When the sphere meets a neighbour that nearly touches it or has a well, on the world's clock \[s\]; infinite if
    /// never.
    fn close_meeting(&self, near: Neighbour) -> f64 {
        let PairQuery { timeline, slot, .. } = *self.query;
        let flights = &timeline.flights;
        let other = &flights.bodies[near.slot() as usize];
        let [own, theirs] = [self.body, other].map(FlightLanes::of_one);
        let start = self.body.time.max(other.time);
        let [shift, image_velocity] = timeline.neighbours.image_motion_of(slot, near, start);
        let image_shift = covers::<CASES>(IMAGES | NEAREST).then(|| shift.into());
        let acceleration = covers::<CASES>(FALLS).then(|| self.species.acceleration.into());
        let mut relative = Relative::between(&own, &theirs, image_shift, acceleration);
        if covers::<CASES>(SLIDES) {
            relative.velocity = relative.velocity + image_velocity.into();
        }
        let their_species = self.species_of(other);
        let mut radius_sum = if covers::<CASES>(FACTORS) {
            flights.contact_distance([self.species, their_species])
        } else {
            self.species.radius + their_species.radius
        };
        let Relative { start, offset, velocity } = relative;
        let mut growth_speed = 0.0;
        if covers::<CASES>(GROWS) {
            growth_speed = self.growth_speed_with(their_species);
            radius_sum += growth_speed * (start - self.growing_since());
        }
        let only_touch = only_touch([self.body, other], &relative, [radius_sum, growth_speed]);
        let [offset, velocity] = [offset, velocity].map(DVec3::from);
        let delay = if covers::<CASES>(WELLS) {
            let slots = [slot, near.slot()];
            flights.time_in_wells(slots, [offset, velocity], radius_sum, only_touch)
        } else if only_touch {
            None
        } else if covers::<CASES>(GROWS) {
            contact_time::sphere_sphere_growing(offset, velocity, radius_sum, growth_speed)
        } else {
            contact_time::sphere_sphere_linear(offset, velocity, radius_sum)
        };
        match delay {
            Some(delay) => start + delay,
            None => f64::INFINITY,
        }
    }
}

#[inline(always)]
const fn covers<const CASES: u16>(case: u16) -> bool {
    CASES & case != 0
}

/// The two least times in each lane, and the numbers that belong to them.
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
        let later = first.select(is_first, time);
        let later_number = first_number.select(is_first, number);
        let is_second = later.is_less(second);
        Self {
            times: [time.select(is_first, first), later.select(is_second, second)],
            numbers: [
                number.select(is_first, first_number),
                later_number.select(is_second, second_number),
            ],
        }
    }

    /// Returns the two earliest times of all lanes, each with its number.
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

/// Whether two spheres touch or overlap a little, and close with no more than the rounding of their speeds. The sum
/// of their radii \[m\] grows with a speed \[m/s\].
fn only_touch(
    bodies: [&Body; 2],
    relative: &Relative<f64>,
    [radius_sum, growth_speed]: [f64; 2],
) -> bool {
    let (offset, velocity) = (DVec3::from(relative.offset), DVec3::from(relative.velocity));
    let gap = offset.length_squared() - radius_sum * radius_sum;
    let speed = bodies.iter().map(|body| body.velocity.norm()).sum::<f64>() + growth_speed;
    let place: f64 = bodies.iter().map(|body| body.position.norm()).sum();
    // Adds how far they move within the rounding of the clock.
    let size = radius_sum + place + speed * relative.start.abs();
    gap.abs() <= NEARLY_TOUCHING * radius_sum * radius_sum
        && gap <= TOUCH_ROUNDING * radius_sum * size
        && radius_sum * growth_speed - offset.dot(velocity) <= TOUCH_ROUNDING * radius_sum * speed
}
