//! Implicit steps, for forces that damp motion in much less than the length of a step.
//!
//! The acceleration is a polynomial through its values at the eight nodes of Gauss-Radau quadrature that include the
//! end of the step (Radau IIA, order 15). The scheme is stable however fast the damping is, and takes what is damped
//! to zero. Its equations are solved by Newton's method. Source: Hairer and Wanner, *Solving Ordinary Differential
//! Equations II* (1996), sections IV.5 and IV.8.

use glam::DVec3;

use super::field::{Field, Start, Values};
use super::interpolate::through;
use super::linear_system::Factorized;
use super::radau_tables::{END_GAINS, END_NEWTON, END_NODES, END_VELOCITIES, END_WAYS, Gains};
use crate::norm::Norm;
use crate::polynomial_flight::TERMS;

/// Most spheres whose equations are solved together.
const MOST_SPHERES: usize = 128;
/// Largest work of an elimination, in the work for one sphere alone: that of sixteen of which each acts on all others.
const MOST_WORK: usize = 4096;
/// Damping over a step \[1\] above which an implicit step is of use. Below it the iteration of other steps converges.
const LEAST_DAMPING: f64 = 1.0;
/// Largest number of iterations of Newton's method.
const MAX_ITERATIONS: u32 = 12;
/// The iteration has converged when accelerations change by less than this part of their scale.
const CONVERGED: f64 = 1e-16;
/// An iteration whose changes stay above this part has not converged.
const DIVERGED: f64 = 1e-10;
/// Change of a velocity by which derivatives are computed, as a part of it: the root of rounding.
const SMALL_PART: f64 = 1e-8;
/// Smallest change of a number by which derivatives are computed, as a part of it.
const LEAST_PART: f64 = 64.0 * f64::EPSILON;
/// Largest change of an acceleration for a derivative, as a part of it.
const MOST_CHANGE: f64 = 0.1;
/// Ratio of two changes that are tried for a derivative.
const SMALLER: f64 = 0.01;
/// An error is negligible if it changes a velocity by less than this part of what a step must resolve.
const VELOCITY_PART: f64 = 1e-5;
/// An error is negligible if it changes a position by less than this part of what a step must resolve: together with
/// the tolerance of a step, rounding of the position.
const POSITION_PART: f64 = 1e-7;

/// A step that was tried.
pub(super) struct Implicit {
    /// Acceleration of each sphere as a sum of powers of the part of the step \[m/s²\].
    pub powers: Vec<[DVec3; TERMS]>,
    /// The error as a part of what is negligible, as a multiple of the tolerance of a step.
    pub error: f64,
}

/// Tries a step of some length \[s\]. Returns `None` where no force damps that fast, and where Newton's method
/// fails.
pub(super) fn attempt(
    start: &Start,
    first: &Values,
    length: f64,
    field: &mut impl Field,
) -> Option<Implicit> {
    if start.positions.len() > MOST_SPHERES || !first.is_finite() {
        return None;
    }
    let slopes = Slopes::of(start, first, length, field)?;
    let order = Order::of(&slopes);
    (order.work() <= MOST_WORK).then_some(())?;
    let equations = slopes.equations_of_nodes(length, &order)?;
    let mut attempt = Attempt::new(start, first, length, &slopes);
    attempt.iterate((&equations, &order), field).then_some(())?;
    let error = attempt.error(&slopes, &order)?;
    Some(Implicit { powers: attempt.powers(), error })
}

/// Derivatives of accelerations at the start of a step, by rows.
struct Slopes {
    /// Number of coordinates.
    count: usize,
    /// \[1/s\]
    by_velocity: Vec<f64>,
    /// \[1/s²\]
    by_position: Vec<f64>,
    /// The fastest damping \[1/s\].
    rate: f64,
}

/// Which quantity of a state is changed for a derivative.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Quantity {
    Position = 0,
    Velocity = 1,
}

impl Slopes {
    /// `None` where damping in a step of some length \[s\] is slow.
    fn of(start: &Start, first: &Values, length: f64, field: &mut impl Field) -> Option<Self> {
        let count = 3 * start.positions.len();
        let rate = fastest_damping(start, length, field);
        (rate * length > LEAST_DAMPING).then(|| {
            let [by_position, by_velocity] =
                [Quantity::Position, Quantity::Velocity].map(|quantity| {
                    derivatives(
                        start,
                        first,
                        (length, quantity),
                        |time, positions, velocities, at| {
                            field.evaluate(time, positions, velocities, at);
                        },
                    )
                });
            Self { count, by_velocity, by_position, rate }
        })
    }

    /// Whether the motion of one sphere changes the acceleration of another.
    fn couple(&self, one: usize, other: usize) -> bool {
        let rows = 3 * one..3 * one + 3;
        rows.into_iter().any(|row| {
            let places = row * self.count + 3 * other..row * self.count + 3 * other + 3;
            places.into_iter().any(|it| self.by_velocity[it] != 0.0 || self.by_position[it] != 0.0)
        })
    }

    /// The equations for the accelerations at all nodes, sphere by sphere: `1 - h A J_v - h² B J_x`.
    fn equations_of_nodes(&self, length: f64, order: &Order) -> Option<Factorized> {
        let h = length;
        let of_sphere = 3 * TERMS;
        let unknown = |number: usize| {
            let (sphere, rest) = (order.spheres[number / of_sphere], number % of_sphere);
            (rest / 3, 3 * sphere + rest % 3)
        };
        let number = |row: usize, column: usize| {
            let ((node, i), (other, j)) = (unknown(row), unknown(column));
            let place = i * self.count + j;
            let coupling = -h * END_VELOCITIES[node][other] * self.by_velocity[place]
                - h * h * END_WAYS[node][other] * self.by_position[place];
            if row == column { 1.0 + coupling } else { coupling }
        };
        Factorized::of(TERMS * self.count, order.reach_of(of_sphere), number)
    }

    /// The matrix `1 - h J_v`, sphere by sphere: its inverse takes what is damped within a step out of an acceleration.
    fn damped(&self, length: f64, order: &Order) -> Option<Factorized> {
        let coordinate = |number: usize| 3 * order.spheres[number / 3] + number % 3;
        let number = |row: usize, column: usize| {
            let place = coordinate(row) * self.count + coordinate(column);
            let damping = -length * self.by_velocity[place];
            if row == column { 1.0 + damping } else { damping }
        };
        Factorized::of(self.count, order.reach_of(3), number)
    }
}

/// An order of spheres in which those that act on each other are near.
///
/// Source: Cuthill and McKee, Proc. 24th Nat. Conf. ACM, 157 (1969).
struct Order {
    /// The sphere at each place.
    spheres: Vec<usize>,
    /// Place of each sphere.
    places: Vec<usize>,
    /// Largest distance of places between which forces act.
    reach: usize,
}

impl Order {
    fn of(slopes: &Slopes) -> Self {
        let count = slopes.count / 3;
        let acts = |one: usize, other: usize| {
            one != other && (slopes.couple(one, other) || slopes.couple(other, one))
        };
        let partners: Vec<Vec<usize>> =
            (0..count).map(|one| (0..count).filter(|&other| acts(one, other)).collect()).collect();
        let mut by_partners: Vec<usize> = (0..count).collect();
        by_partners.sort_by_key(|&sphere| partners[sphere].len());
        let (mut spheres, mut is_known) = (Vec::with_capacity(count), vec![false; count]);
        for first in by_partners {
            let mut next = spheres.len();
            if !std::mem::replace(&mut is_known[first], true) {
                spheres.push(first);
            }
            while let Some(&sphere) = spheres.get(next) {
                next += 1;
                for &partner in &partners[sphere] {
                    if !std::mem::replace(&mut is_known[partner], true) {
                        spheres.push(partner);
                    }
                }
            }
        }
        let mut places = vec![0; count];
        spheres.iter().enumerate().for_each(|(place, &sphere)| places[sphere] = place);
        let distance = |one: usize, &other: &usize| places[one].abs_diff(places[other]);
        let of_sphere = |one: usize| partners[one].iter().map(move |other| distance(one, other));
        let reach = (0..count).flat_map(of_sphere).max().unwrap_or(0);
        Self { spheres, places, reach }
    }

    /// Work of an elimination, in the work for one sphere alone.
    fn work(&self) -> usize {
        self.spheres.len() * (self.reach + 1) * (self.reach + 1)
    }

    /// How far from the diagonal numbers are, with this number of unknowns of each sphere.
    fn reach_of(&self, unknowns: usize) -> usize {
        unknowns * (self.reach + 1) - 1
    }
}

/// Returns the largest rate \[1/s\] at which forces damp a velocity at the start of a step of some length \[s\].
fn fastest_damping(start: &Start, length: f64, field: &mut impl Field) -> f64 {
    let count = 3 * start.positions.len();
    let mut first = Values::of(start.positions.len());
    field.evaluate_forces(start.time, start.positions, start.velocities, &mut first);
    let forces = |time: f64, positions: &[DVec3], velocities: &[DVec3], at: &mut Values| {
        field.evaluate_forces(time, positions, velocities, at);
    };
    let slopes = derivatives(start, &first, (length, Quantity::Velocity), forces);
    (0..count).map(|i| -slopes[i * count + i]).fold(0.0, f64::max)
}

/// Derivatives of all accelerations by a quantity at the start of a step of some length \[s\], by rows. `first` has the
/// accelerations there.
fn derivatives(
    start: &Start,
    first: &Values,
    (length, quantity): (f64, Quantity),
    mut evaluate: impl FnMut(f64, &[DVec3], &[DVec3], &mut Values),
) -> Vec<f64> {
    let spheres = start.positions.len();
    let mut matrix = vec![0.0; 9 * spheres * spheres];
    let mut states = [start.positions.to_vec(), start.velocities.to_vec()];
    let mut values = Values::of(spheres);
    for column in 0..3 * spheres {
        let (sphere, axis) = (column / 3, column % 3);
        let before = states[quantity as usize][sphere];
        let gained = length * first.accelerations[sphere].norm();
        let speed = start.velocities[sphere].norm().max(gained);
        let scale = if quantity == Quantity::Velocity { speed } else { length * speed };
        let least = LEAST_PART * before.norm();
        let mut change = (SMALL_PART * scale).max(least);
        loop {
            states[quantity as usize][sphere][axis] = before[axis] + change;
            evaluate(start.time, &states[0], &states[1], &mut values);
            let gained = (values.accelerations[sphere] - first.accelerations[sphere]).norm();
            let is_small = gained <= MOST_CHANGE * first.sizes[sphere];
            if is_small || change <= least || !change.is_finite() {
                break;
            }
            change = (SMALLER * change).max(least);
        }
        let change = states[quantity as usize][sphere][axis] - before[axis];
        states[quantity as usize][sphere] = before;
        // A sphere at rest at the origin has no change to try.
        for row in (0..3 * spheres).filter(|_| change > 0.0) {
            let (other, axis) = (row / 3, row % 3);
            let gained = values.accelerations[other][axis] - first.accelerations[other][axis];
            matrix[row * 3 * spheres + column] = gained / change;
        }
    }
    matrix
}

/// A step of some length that is tried.
struct Attempt<'a> {
    start: &'a Start<'a>,
    first: &'a Values,
    /// \[s\]
    length: f64,
    /// Accelerations of each sphere at the nodes \[m/s²\].
    at_nodes: Vec<[DVec3; TERMS]>,
    /// Size by which errors of the acceleration of each sphere are measured \[m/s²\].
    scales: Vec<f64>,
}

impl<'a> Attempt<'a> {
    fn new(start: &'a Start<'a>, first: &'a Values, length: f64, slopes: &Slopes) -> Self {
        let count = start.positions.len();
        let scale = |sphere: usize| {
            let (speed, place) = (start.velocities[sphere].norm(), start.positions[sphere].norm());
            let lasting = first.sizes[sphere] / (1.0 + length * slopes.rate);
            lasting + VELOCITY_PART * speed / length + POSITION_PART * place / length / length
        };
        let scales = (0..count).map(scale).collect();
        Self { start, first, length, at_nodes: vec![[DVec3::ZERO; TERMS]; count], scales }
    }

    /// Solves the equations of the nodes. Returns whether Newton's method converges.
    fn iterate(
        &mut self,
        (equations, order): (&Factorized, &Order),
        field: &mut impl Field,
    ) -> bool {
        let spheres = self.at_nodes.len();
        let mut values = Values::of(spheres);
        let mut missing = vec![0.0; 3 * spheres * TERMS];
        let mut change_before = f64::INFINITY;
        for _ in 0..MAX_ITERATIONS {
            let powers = self.powers();
            for (node, &s) in END_NODES.iter().enumerate() {
                let [positions, velocities] = self.states_at(s, &END_GAINS[node], &powers);
                let time = self.start.time + s * self.length;
                field.evaluate(time, &positions, &velocities, &mut values);
                for (sphere, acceleration) in values.accelerations.iter().enumerate() {
                    let place = 3 * (order.places[sphere] * TERMS + node);
                    let missed = *acceleration - self.at_nodes[sphere][node];
                    missing[place..place + 3].copy_from_slice(&missed.to_array());
                }
            }
            equations.solve(&mut missing);
            let change = self.add(&missing, order);
            if !change.is_finite() {
                return false;
            }
            if change <= CONVERGED || change >= change_before {
                return change <= DIVERGED;
            }
            change_before = change;
        }
        change_before <= DIVERGED
    }

    /// Adds changes of the accelerations at the nodes. Returns the largest, as a part of its scale.
    fn add(&mut self, changes: &[f64], order: &Order) -> f64 {
        let mut most = 0.0f64;
        for (place, change) in changes.chunks_exact(3).enumerate() {
            let (node, sphere) = (place % TERMS, order.spheres[place / TERMS]);
            let change = DVec3::from_slice(change);
            self.at_nodes[sphere][node] += change;
            if !change.is_finite() {
                return f64::INFINITY;
            }
            if change != DVec3::ZERO {
                most = most.max(change.norm() / self.scales[sphere]);
            }
        }
        most
    }

    /// Returns the acceleration of each sphere as a sum of powers of the part of the step \[m/s²\].
    fn powers(&self) -> Vec<[DVec3; TERMS]> {
        self.at_nodes.iter().map(|values| through(&END_NODES, &END_NEWTON, *values)).collect()
    }

    /// Where the spheres are at a part of the step, and how they move there.
    fn states_at(&self, s: f64, gains: &Gains, powers: &[[DVec3; TERMS]]) -> [Vec<DVec3>; 2] {
        let states = powers.iter().enumerate().map(|(sphere, powers)| {
            self.start.state_at(sphere, (s, self.length), (powers, gains)).into()
        });
        let (positions, velocities) = states.unzip();
        [positions, velocities]
    }

    /// The error as a part of what it is measured by: the highest term, or how far the polynomial is from the
    /// acceleration at the start, where no node is, without what is damped within the step.
    fn error(&self, slopes: &Slopes, order: &Order) -> Option<f64> {
        let powers = self.powers();
        let missed =
            |&sphere: &usize| (self.first.accelerations[sphere] - powers[sphere][0]).to_array();
        let mut missed: Vec<f64> = order.spheres.iter().flat_map(missed).collect();
        slopes.damped(self.length, order)?.solve(&mut missed);
        let of_each = order.spheres.iter().zip(missed.chunks_exact(3));
        let parts = of_each.map(|(&sphere, missed)| {
            let error = powers[sphere][TERMS - 1].norm().max(DVec3::from_slice(missed).norm());
            if error == 0.0 { 0.0 } else { error / self.scales[sphere] }
        });
        Some(parts.fold(0.0, f64::max)).filter(|error| error.is_finite())
    }
}
