//! Reconstruction of the flights of a step that follow curves.

use std::collections::BTreeMap;

use glam::{DMat3, DVec3};

use super::curved::CurvedFlight;
use super::error::DerivativeError;
use super::linearized::{Companions, Linearized};
use super::replay::{Piece, Replay};
use super::start::ROUNDING;
use crate::integrate::END_NODES;
use crate::polynomial_flight::TERMS;
use crate::rule::exact::JointFlight;
use crate::rule::periodic;

/// Largest difference between the acceleration of a flight and that by the forces, as a part of their size: far above
/// the error of a step, and far below that of a step that the forces do not explain.
const SAME_ACCELERATION: f64 = 1e-6;
/// Largest product of the rates of forces and of the length of a step for which its equations are solved by iteration.
const SHORT: f64 = 1.0;
/// The same where forces grow within the step.
const LONGEST: f64 = 2.0;
/// Largest number of parts of a flight for its forces at the start.
const MOST_PARTS: f64 = 4096.0;
/// Derivatives of forces are smooth over a step if they are off a polynomial by at most this part: the error of the step
/// is smaller by some powers of ten.
const SMOOTH: f64 = 1e-8;
/// Length of the shortest part of a flight as a part of it: at a corner of a force, what is left of the error.
const SHORTEST: f64 = 1e-9;
/// A thread becomes taut where its length is off its rest length by at most this part.
const TAUT: f64 = 1e-9;

/// The curved flights of a step.
pub(super) struct Curves {
    /// In order of their starts.
    joints: Vec<JointFlight>,
    /// Start of each since the start of the step \[s\].
    starts: Vec<f64>,
    /// Numbers of the flights of each sphere, by index of the sphere.
    of_spheres: BTreeMap<usize, Vec<usize>>,
}

/// A part of the curved flights of some spheres.
struct Section<'a> {
    joint: &'a JointFlight,
    /// Start and end since the start of the flights \[s\].
    ages: [f64; 2],
}

impl Curves {
    /// Takes the flights of a step that lasts from `start` to `end` \[s\].
    pub fn new(joints: Vec<JointFlight>, [start, end]: [f64; 2]) -> Self {
        let starts = joints.iter().map(|it| (it.time - start).clamp(0.0, end - start)).collect();
        let mut of_spheres: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for (number, joint) in joints.iter().enumerate() {
            for &(index, _) in &joint.flights {
                of_spheres.entry(index as usize).or_default().push(number);
            }
        }
        Self { joints, starts, of_spheres }
    }

    /// Returns the number of the flight of a sphere from a time since the start of the step on, and its end there
    /// \[s\]: the start of the next one, or infinity.
    fn at(&self, place: usize, since: f64) -> Option<(usize, f64)> {
        let numbers = self.of_spheres.get(&place)?;
        let next = numbers.partition_point(|&number| self.starts[number] <= since);
        let number = *numbers.get(next.checked_sub(1)?)?;
        let end = numbers.get(next).map_or(f64::INFINITY, |&number| self.starts[number]);
        Some((number, end))
    }

    /// Returns the indices of the spheres that fly together with one, itself included, at a time since the start of the
    /// step \[s\].
    fn companions(&self, place: usize, since: f64) -> Vec<usize> {
        let joint = self.at(place, since).map(|(number, _)| &self.joints[number]);
        joint.map_or(vec![place], |joint| places_of(joint))
    }
}

fn places_of(joint: &JointFlight) -> Vec<usize> {
    joint.flights.iter().map(|&(index, _)| index as usize).collect()
}

impl Section<'_> {
    /// Returns the positions \[m\], velocities \[m/s\] and accelerations \[m/s²\] of all spheres at a time since the start
    /// of the flights \[s\].
    fn at(&self, age: f64) -> [Vec<DVec3>; 3] {
        let [mut positions, mut velocities, mut accelerations] =
            [Vec::new(), Vec::new(), Vec::new()];
        for (_, flight) in &self.joint.flights {
            let (position, velocity) = flight.after(age);
            positions.push(position);
            velocities.push(velocity);
            accelerations.push(flight.acceleration.at(age));
        }
        [positions, velocities, accelerations]
    }

    /// Returns the forces at a time since the start of the flights \[s\]; `None` if they are not known or do not explain
    /// the flights.
    fn linearized(&self, companions: &Companions, age: f64) -> Option<Linearized> {
        let [positions, velocities, accelerations] = self.at(age);
        let linearized = companions.linearized([&positions, &velocities], self.joint.time + age)?;
        let tolerance = self.tolerance(&linearized, age);
        let pairs = accelerations.iter().zip(&linearized.accelerations);
        let off = pairs.map(|(a, b)| (*a - *b).length()).fold(0.0, f64::max);
        (off <= tolerance).then_some(linearized)
    }

    /// Returns the largest error of an acceleration at a time since the start of the flights \[s\] that an accurate step
    /// may have \[m/s²\].
    fn tolerance(&self, linearized: &Linearized, age: f64) -> f64 {
        let [positions, velocities, accelerations] = self.at(age);
        let [by_place, by_speed] = rates(linearized, positions.len());
        let over = self.ages[1] - self.ages[0];
        let most = |vectors: &[DVec3]| vectors.iter().map(|it| it.length()).fold(0.0, f64::max);
        let speed = most(&velocities);
        let size = most(&accelerations) + by_place * over * speed + by_speed * speed;
        SAME_ACCELERATION * size + ROUNDING * by_place * most(&positions)
    }
}

/// Returns bounds of the changes of accelerations by places \[1/s²\] and by velocities \[1/s\].
fn rates(linearized: &Linearized, count: usize) -> [f64; 2] {
    let size = |it: &DMat3| it.to_cols_array().map(f64::abs).iter().sum::<f64>();
    let mut sums = vec![[0.0; 2]; count];
    for it in &linearized.couplings {
        sums[it.spheres[0]][0] += size(&it.by_position);
        sums[it.spheres[0]][1] += size(&it.by_velocity);
    }
    [0, 1].map(|which| sums.iter().map(|it| it[which]).fold(0.0, f64::max))
}

impl Replay<'_> {
    /// Advances a sphere on a curve, and all that fly with it, to a time since the start of the step \[s\].
    pub fn fly_on_curve(&mut self, place: usize, time: f64) -> Result<(), DerivativeError> {
        while self.start.bodies[place].since < time {
            let since = self.start.bodies[place].since;
            let (number, end) = self.curves.at(place, since).ok_or_else(|| self.lost(place))?;
            self.fly_together(number, end.min(time)).ok_or_else(|| self.lost(place))?;
        }
        Ok(())
    }

    /// Advances spheres on one of the curved flights to a time since the start of the step \[s\]; `None` if the flight
    /// does not continue the motion so far, or has no known derivative.
    fn fly_together(&mut self, number: usize, time: f64) -> Option<()> {
        let joint = &self.curves.joints[number];
        let places = places_of(joint);
        let since = self.start.bodies[*places.first()?].since;
        let ages = [since, time].map(|at| self.start.time + at - joint.time);
        let section = Section { joint, ages: [ages[0].max(0.0), ages[1]] };
        let mut companions = Companions::of(self.system, &places)?;
        let is_one = |place: &usize| {
            let body = &self.start.bodies[*place];
            body.since == since && body.held.is_none() && body.is_curved
        };
        (joint.is_complete && places.iter().all(is_one)).then_some(())?;
        let [starts, ends] = section.ages.map(|age| section.at(age));
        let taut_or_slack = companions.clone();
        let [positions, velocities, _] = section.at(0.5 * (section.ages[0] + section.ages[1]));
        companions.fix_threads([&positions, &velocities]);
        let first = section.linearized(&companions, section.ages[0])?;
        let tolerance = section.tolerance(&first, section.ages[0]);
        let jumps = self.jumps(&places, &starts[2], tolerance);
        let tightening = match jumps.is_empty() {
            true => None,
            false => Some(taut_or_slack.tightening([&starts[0], &starts[1]], (TAUT, &jumps))?),
        };
        let mut parts = Vec::new();
        add_parts(&section, &companions, &places, &mut parts)?;
        let period = self.system.settings.boundary.period();
        for (at, &place) in places.iter().enumerate() {
            let body = &mut self.start.bodies[place];
            let off = periodic::wrapped(starts[0][at] - body.position, period);
            let speed = starts[1][at].length() + ends[1][at].length() + body.velocity.length();
            let goes_on = off.length() <= body.tolerance
                && (starts[1][at] - body.velocity).length() <= ROUNDING * speed;
            goes_on.then_some(())?;
            body.tolerance += ROUNDING * (ends[0][at] - starts[0][at]).length();
            (body.position, body.velocity) = (ends[0][at], ends[1][at]);
            (body.acceleration, body.since) = (Some(ends[2][at]), time);
        }
        self.pieces.extend(tightening.map(|it| Piece::Tightening(Box::new(it))));
        self.pieces.extend(parts.into_iter().map(|it| Piece::Curved(Box::new(it))));
        Some(())
    }

    /// Returns the spheres, by index, whose accelerations \[m/s²\] at the start of a section are off those at the end of
    /// the last one by more than a tolerance, and how much smaller they are.
    fn jumps(&self, places: &[usize], starts: &[DVec3], tolerance: f64) -> Vec<(usize, DVec3)> {
        let lost = |(&place, start): (&usize, &DVec3)| {
            let lost = self.start.bodies[place].acceleration? - *start;
            (lost.length() > tolerance).then_some((place, lost))
        };
        places.iter().zip(starts).filter_map(lost).collect()
    }

    /// Returns the accelerations \[m/s²\] of spheres on curves, by index, and of those that fly with them.
    pub fn accelerations_on_curves(&self, struck: [Option<usize>; 2]) -> Vec<(usize, DVec3)> {
        let bodies = &self.start.bodies;
        let mut all: Vec<(usize, DVec3)> = Vec::new();
        for place in struck.into_iter().flatten().filter(|&place| bodies[place].is_curved) {
            if all.iter().any(|it| it.0 == place) {
                continue;
            }
            let since = bodies[place].since;
            let places = self.curves.companions(place, since);
            let Some(companions) = Companions::of(self.system, &places) else { continue };
            let positions: Vec<DVec3> = places.iter().map(|&it| bodies[it].position).collect();
            let velocities: Vec<DVec3> = places.iter().map(|&it| bodies[it].velocity).collect();
            let time = self.start.time + since;
            let accelerations = companions.accelerations([&positions, &velocities], time);
            all.extend(places.iter().copied().zip(accelerations));
        }
        all
    }
}

/// Adds the derivative of a section of flights, in parts that are short for the forces, and over which these are smooth.
/// `None` if it is not known.
fn add_parts(
    section: &Section,
    companions: &Companions,
    places: &[usize],
    parts: &mut Vec<CurvedFlight>,
) -> Option<()> {
    let [start, end] = section.ages;
    let first = section.linearized(companions, start)?;
    let [by_place, by_speed] = rates(&first, places.len());
    let rate = by_speed + by_place.sqrt();
    let count = (rate * (end - start) / SHORT).ceil().max(1.0);
    (count <= MOST_PARTS).then_some(())?;
    let length = (end - start) / count;
    let starts = (0..count as u32).map(|part| start + f64::from(part) * length);
    for start in starts {
        add_part(section, companions, (places, start, length), parts)?;
    }
    Some(())
}

/// Adds the derivative of a part of a section that begins at a time since the start of the flights \[s\]: in halves where
/// forces are not smooth.
fn add_part(
    section: &Section,
    companions: &Companions,
    (places, start, length): (&[usize], f64, f64),
    parts: &mut Vec<CurvedFlight>,
) -> Option<()> {
    let nodes = END_NODES.map(|node| section.linearized(companions, start + node * length));
    let known: Vec<Linearized> = nodes.into_iter().flatten().collect();
    let nodes: [Linearized; TERMS] = known.try_into().ok()?;
    let first = section.linearized(companions, start)?;
    let [by_place, by_speed] = rates(&first, places.len());
    let rate = by_speed + by_place.sqrt();
    let shortest = SHORTEST * (section.ages[1] - section.ages[0]);
    let is_smooth = off_polynomial(&first, &nodes) <= SMOOTH && rate * length <= LONGEST;
    if is_smooth || length <= shortest {
        let nodes = nodes.map(|it| Linearized { accelerations: Vec::new(), ..it });
        parts.push(CurvedFlight { places: places.to_vec(), time: length, nodes });
        return Some(());
    }
    let half = 0.5 * length;
    add_part(section, companions, (places, start, half), parts)?;
    add_part(section, companions, (places, start + half, half), parts)
}

/// Returns by which part of them the derivatives of accelerations at the start of a step are off the polynomials through
/// those at its nodes.
fn off_polynomial(first: &Linearized, nodes: &[Linearized; TERMS]) -> f64 {
    let is_alike = |it: &Linearized| it.couplings.len() == first.couplings.len();
    if !nodes.iter().all(is_alike) {
        return f64::INFINITY;
    }
    let (mut off, mut size) = ([0.0f64; 2], [0.0f64; 2]);
    for (number, coupling) in first.couplings.iter().enumerate() {
        let at_nodes = nodes.iter().zip(WEIGHTS_AT_START);
        let (mut by_position, mut by_velocity) = (coupling.by_position, coupling.by_velocity);
        for (node, weight) in at_nodes {
            by_position -= weight * node.couplings[number].by_position;
            by_velocity -= weight * node.couplings[number].by_velocity;
        }
        let most =
            |it: &DMat3| it.to_cols_array().into_iter().fold(0.0, |a: f64, b| a.max(b.abs()));
        off = [off[0].max(most(&by_position)), off[1].max(most(&by_velocity))];
        let sizes = [most(&coupling.by_position), most(&coupling.by_velocity)];
        size = [size[0].max(sizes[0]), size[1].max(sizes[1])];
    }
    let part = |which: usize| if off[which] == 0.0 { 0.0 } else { off[which] / size[which] };
    part(0).max(part(1))
}

/// Values at the start of a step of the polynomials that are 1 at one of [`END_NODES`] and 0 at the others.
const WEIGHTS_AT_START: [f64; TERMS] = {
    let mut weights = [1.0; TERMS];
    let mut own = 0;
    while own < TERMS {
        let mut other = 0;
        while other < TERMS {
            if other != own {
                weights[own] *= END_NODES[other] / (END_NODES[other] - END_NODES[own]);
            }
            other += 1;
        }
        own += 1;
    }
    weights
};
