//! The derivative of flights on curves: the variational equation along them.

use glam::DVec3;

use super::linearized::{Coupling, Linearized};
use super::state::SphereTangent;
use super::variation::Variation;
use crate::integrate::{END_NODES, END_VELOCITIES, END_WAYS};
use crate::polynomial_flight::TERMS;

/// Largest number of iterations for the accelerations at the nodes. Steps that are short enough take less than half
/// of it.
const MAX_ITERATIONS: u32 = 60;
/// The iteration has converged when the accelerations change by less than this part of them.
const CONVERGED: f64 = 1e-17;

/// Derivative of the flights of some spheres over one step.
///
/// Small changes follow `δa = A δx + B δv + c`, linearised about the flights. It is solved at the nodes of Radau IIA
/// (Hairer and Wanner, *Solving Ordinary Differential Equations II* (1996), section IV.5), of order 15 as the flights
/// themselves.
#[derive(Debug, Clone)]
pub(super) struct CurvedFlight {
    /// Indices of the spheres in the arrays of the world.
    pub places: Vec<usize>,
    /// Length of the step \[s\].
    pub time: f64,
    /// Forces at the nodes.
    pub nodes: [Linearized; TERMS],
}

impl CurvedFlight {
    /// Applies the derivative of the flights to the derivatives of the spheres in one direction.
    pub fn pass(
        &self,
        (direction, accelerations): (&Variation, &[DVec3]),
        spheres: &mut [SphereTangent],
    ) {
        let before: Vec<SphereTangent> = self.places.iter().map(|&place| spheres[place]).collect();
        let h = self.time;
        let mut given = self.zeros();
        for (node, linearized) in self.nodes.iter().enumerate() {
            let given = self.at_mut(&mut given, node);
            for (given, &place) in given.iter_mut().zip(&self.places) {
                *given = accelerations[place];
            }
            for it in &linearized.influences {
                given[it.sphere] += it.input.of(direction) * it.rate;
            }
            let straight = END_NODES[node] * h;
            for Coupling { spheres: [on, of], by_position, by_velocity } in &linearized.couplings {
                let SphereTangent { position, velocity, .. } = before[*of];
                given[*on] += *by_position * (position + straight * velocity);
                given[*on] += *by_velocity * velocity;
            }
        }
        let accelerations = Self::solve(given, |accelerations, next| {
            self.add_response(accelerations, next);
        });
        let [way, gained] = self.integrals(&accelerations, TERMS - 1);
        for (number, &place) in self.places.iter().enumerate() {
            spheres[place].position += h * before[number].velocity + way[number];
            spheres[place].velocity += gained[number];
        }
    }

    /// Replaces derivatives with respect to the motion at the end by derivatives with respect to the motion at the
    /// start, and adds those with respect to other inputs to a gradient: the transpose of [`Self::pass`].
    pub fn pass_back(
        &self,
        spheres: &mut [SphereTangent],
        (gradient, accelerations): (&mut Variation, &mut [DVec3]),
    ) {
        let after: Vec<SphereTangent> = self.places.iter().map(|&place| spheres[place]).collect();
        let h = self.time;
        let mut given = self.zeros();
        for node in 0..TERMS {
            let (way, gained) =
                (h * h * END_WAYS[TERMS - 1][node], h * END_VELOCITIES[TERMS - 1][node]);
            for (given, after) in self.at_mut(&mut given, node).iter_mut().zip(&after) {
                *given = way * after.position + gained * after.velocity;
            }
        }
        let by_acceleration = Self::solve(given, |by_acceleration, next| {
            self.add_transposed_response(by_acceleration, next);
        });
        for &place in &self.places {
            let it = &mut spheres[place];
            it.velocity += h * it.position;
        }
        for (node, linearized) in self.nodes.iter().enumerate() {
            let by = self.at(&by_acceleration, node);
            for (&place, by) in self.places.iter().zip(by) {
                accelerations[place] += *by;
            }
            for it in &linearized.influences {
                *it.input.in_gradient(gradient) += it.rate.dot(by[it.sphere]);
            }
            let straight = END_NODES[node] * h;
            for Coupling { spheres: [on, of], by_position, by_velocity } in &linearized.couplings {
                let sphere = &mut spheres[self.places[*of]];
                let by_place = by_position.transpose() * by[*on];
                sphere.position += by_place;
                sphere.velocity += straight * by_place + by_velocity.transpose() * by[*on];
            }
        }
    }

    /// Solves `x = given + response(x)` by iteration, where vectors are by node and then by sphere; `add_response` adds the response to its second argument.
    fn solve(given: Vec<DVec3>, add_response: impl Fn(&[DVec3], &mut [DVec3])) -> Vec<DVec3> {
        let mut solution = given.clone();
        let mut change_before = f64::INFINITY;
        for _ in 0..MAX_ITERATIONS {
            let mut next = given.clone();
            add_response(&solution, &mut next);
            let pairs = || next.iter().zip(&solution);
            let change = pairs().map(|(a, b)| (*a - *b).abs().max_element()).fold(0.0, f64::max);
            let size = next.iter().map(|it| it.abs().max_element()).fold(0.0, f64::max);
            solution = next;
            // Below rounding, changes no longer shrink.
            if change <= CONVERGED * size || (change >= change_before && change <= 1e-14 * size) {
                break;
            }
            change_before = change;
        }
        solution
    }

    /// Adds the accelerations at all nodes that the displacements by accelerations cause.
    fn add_response(&self, accelerations: &[DVec3], next: &mut [DVec3]) {
        for (node, linearized) in self.nodes.iter().enumerate() {
            let [way, gained] = self.integrals(accelerations, node);
            let next = self.at_mut(next, node);
            for Coupling { spheres: [on, of], by_position, by_velocity } in &linearized.couplings {
                next[*on] += *by_position * way[*of] + *by_velocity * gained[*of];
            }
        }
    }

    /// The transpose of [`Self::add_response`].
    fn add_transposed_response(&self, by_acceleration: &[DVec3], next: &mut [DVec3]) {
        let h = self.time;
        for (node, linearized) in self.nodes.iter().enumerate() {
            let by = self.at(by_acceleration, node);
            let mut by_way = vec![DVec3::ZERO; self.places.len()];
            let mut by_gain = by_way.clone();
            for Coupling { spheres: [on, of], by_position, by_velocity } in &linearized.couplings {
                by_way[*of] += by_position.transpose() * by[*on];
                by_gain[*of] += by_velocity.transpose() * by[*on];
            }
            for other in 0..TERMS {
                let (way, gained) =
                    (h * h * END_WAYS[node][other], h * END_VELOCITIES[node][other]);
                let next = self.at_mut(next, other).iter_mut();
                for (next, (by_way, by_gain)) in next.zip(by_way.iter().zip(&by_gain)) {
                    *next += way * *by_way + gained * *by_gain;
                }
            }
        }
    }

    /// Returns the displacement of each sphere \[m\] and its change of velocity \[m/s\] up to a node by accelerations.
    fn integrals(&self, accelerations: &[DVec3], node: usize) -> [Vec<DVec3>; 2] {
        let (h, count) = (self.time, self.places.len());
        let mut sums = [vec![DVec3::ZERO; count], vec![DVec3::ZERO; count]];
        for other in 0..TERMS {
            let (way, gained) = (h * h * END_WAYS[node][other], h * END_VELOCITIES[node][other]);
            for (number, acceleration) in self.at(accelerations, other).iter().enumerate() {
                sums[0][number] += way * *acceleration;
                sums[1][number] += gained * *acceleration;
            }
        }
        sums
    }

    fn zeros(&self) -> Vec<DVec3> {
        vec![DVec3::ZERO; TERMS * self.places.len()]
    }

    fn at<'a>(&self, vectors: &'a [DVec3], node: usize) -> &'a [DVec3] {
        let count = self.places.len();
        &vectors[node * count..(node + 1) * count]
    }

    fn at_mut<'a>(&self, vectors: &'a mut [DVec3], node: usize) -> &'a mut [DVec3] {
        let count = self.places.len();
        &mut vectors[node * count..(node + 1) * count]
    }
}
