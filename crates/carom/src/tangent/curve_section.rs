//! A part of the curved flights of some spheres, and its derivative.

use glam::{DMat3, DVec3};

use super::curved::CurvedFlight;
use super::linearized::{Companions, Linearized};
use super::start::ROUNDING;
use crate::integrate::END_NODES;
use crate::polynomial_flight::TERMS;
use crate::rule::exact::JointFlight;

/// Largest difference between the acceleration of a flight and that by the forces, as a part of their size: far above
/// the error of a step, and far below that of a step that the forces do not explain.
const SAME_ACCELERATION: f64 = 1e-6;
/// Largest product of the rates of forces and of the length of a step for which its equations are solved by iteration.
const SHORT: f64 = 1.0;
/// The same where forces grow within the step.
const LONGEST: f64 = 2.0;
/// Largest number of parts of a flight for its forces at the start.
const MOST_PARTS: f64 = 4096.0;
/// Derivatives of forces are smooth over a step if they are off a polynomial by at most what adds this to the derivative
/// of the flight: the error of the step is smaller by some powers of ten.
const SMOOTH: f64 = 1e-8;
/// Length of the shortest part of a flight as a part of it: at a corner of a force, what is left of the error.
const SHORTEST: f64 = 1e-9;

/// A part of the curved flights of some spheres.
pub(super) struct Section<'a> {
    pub joint: &'a JointFlight,
    /// Start and end since the start of the flights \[s\].
    pub ages: [f64; 2],
}

impl Section<'_> {
    /// Returns the positions \[m\], velocities \[m/s\] and accelerations \[m/s²\] of all spheres at a time since the start
    /// of the flights \[s\].
    pub fn at(&self, age: f64) -> [Vec<DVec3>; 3] {
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
    pub fn linearized(&self, companions: &Companions, age: f64) -> Option<Linearized> {
        let [positions, velocities, accelerations] = self.at(age);
        let linearized = companions.linearized([&positions, &velocities], self.joint.time + age)?;
        let tolerance = self.tolerance(&linearized, age);
        let pairs = accelerations.iter().zip(&linearized.accelerations);
        let off = pairs.map(|(a, b)| (*a - *b).length()).fold(0.0, f64::max);
        (off <= tolerance).then_some(linearized)
    }

    /// Returns the largest error of an acceleration at a time since the start of the flights \[s\] that an accurate step
    /// may have \[m/s²\].
    pub fn tolerance(&self, linearized: &Linearized, age: f64) -> f64 {
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

/// Adds the derivative of a section of flights, in parts that are short for the forces, and over which these are smooth.
/// `None` if it is not known.
pub(super) fn add_parts(
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
        add_part(section, companions, places, [start, length], parts)?;
    }
    Some(())
}

/// Adds the derivative of a part of a section, by its start since that of the flights and its length \[s\]: in halves
/// where forces are not smooth.
fn add_part(
    section: &Section,
    companions: &Companions,
    places: &[usize],
    [start, length]: [f64; 2],
    parts: &mut Vec<CurvedFlight>,
) -> Option<()> {
    let nodes = END_NODES.map(|node| section.linearized(companions, start + node * length));
    let known: Vec<Linearized> = nodes.into_iter().flatten().collect();
    let nodes: [Linearized; TERMS] = known.try_into().ok()?;
    let first = section.linearized(companions, start)?;
    let [by_place, by_speed] = rates(&first, places.len());
    let rate = by_speed + by_place.sqrt();
    let shortest = SHORTEST * (section.ages[1] - section.ages[0]);
    let is_smooth = off_polynomial(&first, &nodes, length) <= SMOOTH && rate * length <= LONGEST;
    if is_smooth || length <= shortest {
        let nodes = nodes.map(|it| Linearized { accelerations: Vec::new(), ..it });
        parts.push(CurvedFlight { places: places.to_vec(), time: length, nodes });
        return Some(());
    }
    let half = 0.5 * length;
    add_part(section, companions, places, [start, half], parts)?;
    add_part(section, companions, places, [start + half, half], parts)
}

/// Returns how far the derivatives of accelerations at the start of a step of some length \[s\] are off the polynomials
/// through those at its nodes: what that adds to the derivative of the flight, at most.
fn off_polynomial(first: &Linearized, nodes: &[Linearized; TERMS], length: f64) -> f64 {
    let is_alike = |it: &Linearized| it.couplings.len() == first.couplings.len();
    if !nodes.iter().all(is_alike) {
        return f64::INFINITY;
    }
    let most = |it: &DMat3| it.to_cols_array().into_iter().fold(0.0, |a: f64, b| a.max(b.abs()));
    let off = first.couplings.iter().enumerate().map(|(number, coupling)| {
        let (mut by_position, mut by_velocity) = (coupling.by_position, coupling.by_velocity);
        for (node, weight) in nodes.iter().zip(WEIGHTS_AT_START) {
            by_position -= weight * node.couplings[number].by_position;
            by_velocity -= weight * node.couplings[number].by_velocity;
        }
        length * length * most(&by_position) + length * most(&by_velocity)
    });
    off.fold(0.0, f64::max)
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
