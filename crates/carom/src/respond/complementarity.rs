//! The linear complementarity problem of a group of contacts.
//!
//! Impulses (or forces) x, one per contact, change the velocities (or accelerations) v of the
//! bodies by `M⁻¹ N x`, and so the rates of opening `u = Nᵀ v − target`. Wanted are
//!
//! ```text
//! x >= 0,   u = u₀ + A x >= 0,   x·u = 0,        A = Nᵀ M⁻¹ N
//! ```
//!
//! which is the minimum of `½ xᵀ A x + u₀ᵀ x` over `x >= 0`. A is positive semi-definite; it is
//! singular where contacts are redundant, and then the velocities are unique, the impulses not.

use glam::DVec3;

use super::face::Face;
use super::order_free::{self, Steps, sum_of};
use super::problem::{Link, Problem, Tolerance, push};
use crate::work::Work;

/// How a solution ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Outcome {
    /// All conditions hold to the tolerance.
    Solved,
    /// No impulses, however large, fulfil the conditions: some would press bodies together
    /// without moving them.
    Jammed,
    /// The bound of iterations was met first.
    Unfinished,
}

/// A direction that moves bodies by less than this part (squared) of what its impulses would do
/// one by one is one that does not move them: unit normals are such to a few roundings, and this
/// is the square of 16 of them.
const STANDSTILL: f64 = 256.0 * f64::EPSILON * f64::EPSILON;

/// Iterations, per contact and besides, before the quick method gives way to the careful one.
/// Conjugate gradients on exact numbers need one for each contact of the final face.
const QUICK: usize = 200;
const QUICK_PER_LINK: usize = 4;

/// Contacts up to which there is a careful method: its memory and time grow with the square and
/// the cube of their number.
const CAREFUL_LINKS: usize = 300;

/// Iterations, per contact and besides, of the careful method. It ends by itself, but where many
/// contacts are redundant it may go through many faces that differ by rounding.
const CAREFUL: usize = 100;
const CAREFUL_PER_LINK: usize = 2;

/// Where both methods have been through their iterations, rates that miss the conditions by less than
/// this part of the largest are taken: among redundant contacts rounding adds up to so much.
const ACCEPTED: f64 = 1e-9;

/// Iterations times contacts of the quick method where there is no other: some seconds' work.
const QUICK_WORK: usize = 20_000_000;

/// Part of the norm of A's bound that a step of fixed length takes; must be below 2, and is best
/// close to it (Dostál, "Optimal Quadratic Programming Algorithms", 2009, section 5.9).
const STEP_LENGTH: f64 = 1.9;

/// Iterations without progress after which a solution within the coarse tolerance is taken.
const PATIENCE: usize = 4;

/// Multiplications of a factor that take as long as one unit of work.
const UNITS_PER_FACTOR: u64 = 30;

/// What is done where a step would take an impulse below zero.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Leaving {
    /// A step of fixed length follows, cut off at zero: many impulses may end at once.
    Projected,
    /// It ends there; other contacts are taken up only once all that have impulses are right.
    Stopped,
}

/// A way down to the minimum.
#[derive(Debug, Clone, Copy)]
struct Descent {
    leaving: Leaving,
    /// Iterations at most.
    bound: usize,
    /// Units of work of one iteration.
    units: u64,
}

/// Working memory of [`Solver::solve`].
///
/// The quick method is modified proportioning with reduced gradient projections (Dostál and
/// Schöberl, "Minimizing quadratic functions over non-negative cone with the rate of convergence
/// and finite termination", Comput. Optim. Appl. 30, 2005): conjugate gradients among the
/// contacts with impulses, projected steps where an impulse would fall below zero, and gradient
/// steps that take up contacts that close. It needs no more of A than the graph of contacts.
///
/// Where that is slow, because masses differ by many powers of ten, and contacts are not too
/// many, the careful method takes over from where it got to: that of faces (Polyak, "The conjugate gradient method in extremal
/// problems", USSR Comput. Math. Math. Phys. 9, 1969), which finds the minimum among the contacts
/// with impulses before it takes up others, and ends after finitely many faces.
///
/// The quick method does everything to all contacts alike, or is a sum that does not depend on
/// the order ([`order_free`]). So mirrored or renumbered problems give mirrored or renumbered
/// solutions, to the last bit. The gradient is computed from the velocities in every
/// iteration, which keeps them right even where large impulses on a light body nearly cancel.
#[derive(Debug, Clone, Default)]
pub(super) struct Solver {
    /// Power of two near `1/√A_ii`, which evens out masses without rounding anything; and its inverse.
    scales: Vec<f64>,
    inverse_scales: Vec<f64>,
    /// Scaled impulses and rates, one per contact.
    x: Vec<f64>,
    gradient: Vec<f64>,
    direction: Vec<f64>,
    /// A times the direction, as rates of contacts and as velocities of bodies.
    image: Vec<f64>,
    moved: Vec<DVec3>,
    /// Direction times image.
    curvature: f64,
    steps: Vec<Steps<DVec3>>,
    /// Terms of a sum, one per contact.
    terms: Vec<f64>,
    /// Number of contacts of each body, and the largest of their scales.
    crowds: Vec<(f64, f64)>,
    /// Largest violation of the conditions by the rates of the last solution.
    missed: f64,
    /// Length of a step along the gradient that never overshoots.
    step_length: f64,
    face: Face,
}

impl Solver {
    /// Solves the problem, beginning without impulses, and moves the velocities with it.
    ///
    /// - `velocities`: one per body, of the problem's masses; read and written
    /// - `impulses`: one per contact, in units of the problem's masses; written
    pub fn solve(
        &mut self,
        problem: &Problem,
        work: &Work,
        velocities: &mut [DVec3],
        impulses: &mut Vec<f64>,
    ) -> Outcome {
        impulses.clear();
        if let [link] = problem.links[..] {
            work.spend(1);
            self.missed = 0.0;
            impulses.push(solve_one(&link, &problem.inverse_masses, velocities));
            return Outcome::Solved;
        }
        let links = problem.links.len();
        let (quick, careful) = if links <= CAREFUL_LINKS {
            (QUICK + QUICK_PER_LINK * links, CAREFUL + CAREFUL_PER_LINK * links)
        } else {
            (QUICK_WORK / links, 0)
        };
        let units = links as u64;
        let quick = Descent { leaving: Leaving::Projected, bound: quick, units };
        // Its factor costs the square of the contacts times the bodies, of which there are as many.
        let units = units * units * units / UNITS_PER_FACTOR;
        let careful = Descent { leaving: Leaving::Stopped, bound: careful, units };
        self.prepare(problem);
        self.measure(problem, velocities);
        let mut outcome = self.descend(problem, work, velocities, quick);
        if outcome == Outcome::Unfinished {
            outcome = self.descend(problem, work, velocities, careful);
        }
        self.missed = self.violation();
        let is_accepted = self.missed <= ACCEPTED * problem.tolerance.scale;
        if outcome != Outcome::Solved && is_accepted {
            outcome = Outcome::Solved;
        }
        impulses.extend(self.x.iter().zip(&self.scales).map(|(x, scale)| x * scale));
        outcome
    }

    /// Goes down to the minimum by one method, from where x and the velocities are.
    fn descend(
        &mut self,
        problem: &Problem,
        work: &Work,
        velocities: &mut [DVec3],
        Descent { leaving, bound, units }: Descent,
    ) -> Outcome {
        let Tolerance { fine, coarse, .. } = problem.tolerance;
        let mut best = f64::INFINITY;
        let mut without_progress = 0;
        // Whether the direction is already the one to go on with.
        let mut conjugate = false;
        for _ in 0..bound {
            if !work.spend(units) {
                return Outcome::Unfinished;
            }
            let violation = self.violation();
            if violation < best {
                (best, without_progress) = (violation, 0);
            } else {
                without_progress += 1;
            }
            let good_enough = violation <= coarse && without_progress > PATIENCE;
            if violation <= fine || good_enough {
                return Outcome::Solved;
            }
            let on_face = match leaving {
                Leaving::Projected => self.is_proportional(),
                // A whole step that leaves no more than rounding has found the minimum.
                Leaving::Stopped => {
                    self.violation_on_face() > if conjugate { coarse } else { fine }
                }
            };
            if !on_face {
                self.direction_of_closing();
            } else if leaving == Leaving::Stopped {
                self.direction_to_minimum(problem);
            } else if !conjugate {
                self.direction_of_free();
            }
            self.apply(problem);
            let Some(length) = self.best_length() else {
                let solved = violation <= coarse;
                return if solved { Outcome::Solved } else { Outcome::Jammed };
            };
            let reach = self.reach();
            self.advance(length.min(reach), velocities);
            self.measure(problem, velocities);
            conjugate = on_face && length <= reach;
            if leaving == Leaving::Projected && conjugate {
                self.make_conjugate();
            } else if leaving == Leaving::Projected && on_face {
                self.project(problem, velocities);
                self.measure(problem, velocities);
            }
        }
        if self.violation() <= coarse { Outcome::Solved } else { Outcome::Unfinished }
    }

    /// Returns the largest violation of the conditions by the rates of the last solution.
    pub fn missed(&self) -> f64 {
        self.missed
    }

    /// Sizes the arrays and finds the scales.
    fn prepare(&mut self, problem: &Problem) {
        let (links, bodies) = (problem.links.len(), problem.inverse_masses.len());
        let inverse_mass = |body: u32| problem.inverse_masses[body as usize];
        self.scales.clear();
        self.scales.extend(problem.links.iter().map(|link| {
            let diagonal = inverse_mass(link.second) + link.first.map_or(0.0, inverse_mass);
            order_free::power_of_two(-(order_free::exponent_of(diagonal) >> 1))
        }));
        self.inverse_scales.clear();
        self.inverse_scales.extend(self.scales.iter().map(|scale| 1.0 / scale));
        for array in [&mut self.x, &mut self.gradient, &mut self.direction, &mut self.image] {
            array.clear();
            array.resize(links, 0.0);
        }
        self.moved.clear();
        self.moved.resize(bodies, DVec3::ZERO);
        self.steps.clear();
        self.steps.resize(bodies, Default::default());
        self.face.clear();
        self.step_length = STEP_LENGTH / self.norm_bound(problem);
    }

    /// A bound of the norm of the scaled A, by the sums of its rows (Gershgorin).
    fn norm_bound(&mut self, problem: &Problem) -> f64 {
        let crowds = &mut self.crowds;
        crowds.clear();
        crowds.resize(problem.inverse_masses.len(), (0.0, 0.0));
        for (link, &scale) in problem.links.iter().zip(&self.scales) {
            for body in link.first.into_iter().chain([link.second]) {
                let (count, largest) = &mut crowds[body as usize];
                *count += 1.0;
                *largest = scale.max(*largest);
            }
        }
        let row = |(link, scale): (&Link, &f64)| {
            let part = |body: u32| {
                let (count, largest) = crowds[body as usize];
                problem.inverse_masses[body as usize] * count * largest
            };
            scale * (part(link.second) + link.first.map_or(0.0, part))
        };
        problem.links.iter().zip(&self.scales).map(row).fold(0.0, f64::max)
    }

    /// The gradient: scaled rates of opening. Those below the fine tolerance count as zero: to
    /// follow their rounding would disturb contacts at lighter bodies.
    fn measure(&mut self, problem: &Problem, velocities: &[DVec3]) {
        for (i, link) in problem.links.iter().enumerate() {
            let rate = link.rate(velocities);
            let told_apart = rate.abs() > problem.tolerance.fine;
            self.gradient[i] = if told_apart { self.scales[i] * rate } else { 0.0 };
        }
    }

    /// Returns the largest violation of the conditions by rates.
    fn violation(&self) -> f64 {
        let missed = |(x, g): (&f64, &f64)| if *x > 0.0 { g.abs() } else { -g };
        let missed = self.x.iter().zip(&self.gradient).map(missed);
        largest(missed.zip(&self.inverse_scales).map(|(missed, inverse)| missed * inverse))
    }

    /// Returns the largest rate of a contact with an impulse, which should be zero.
    fn violation_on_face(&self) -> f64 {
        let missed = self.x.iter().zip(&self.gradient).map(|(x, g)| free(*x, *g).abs());
        largest(missed.zip(&self.inverse_scales).map(|(missed, inverse)| missed * inverse))
    }

    /// Whether more is to be gained among contacts with impulses than by taking up others.
    fn is_proportional(&mut self) -> bool {
        let Self { x, gradient, terms, step_length, .. } = self;
        let reduced = |(x, g): (&f64, &f64)| {
            let (free, most) = (free(*x, *g), *x / *step_length);
            if free < most { free * free } else { most * free }
        };
        let closing = |(x, g): (&f64, &f64)| closing(*x, *g) * closing(*x, *g);
        let pairs = || x.iter().zip(&*gradient);
        let gained_on_face = sum_of(terms, pairs().map(reduced));
        sum_of(terms, pairs().map(closing)) <= gained_on_face
    }

    fn direction_of_closing(&mut self) {
        let Self { x, gradient, direction, .. } = self;
        for ((direction, x), g) in direction.iter_mut().zip(x).zip(gradient) {
            *direction = closing(*x, *g);
        }
    }

    fn direction_to_minimum(&mut self, problem: &Problem) {
        let Self { face, x, scales, gradient, direction, .. } = self;
        face.set(problem, scales, |contact| x[contact] > 0.0);
        face.solve(gradient, direction);
    }

    fn direction_of_free(&mut self) {
        let Self { x, gradient, direction, .. } = self;
        for ((direction, x), g) in direction.iter_mut().zip(x).zip(gradient) {
            *direction = free(*x, *g);
        }
    }

    /// Computes how impulses along the direction change bodies and rates.
    fn apply(&mut self, problem: &Problem) {
        self.push_along_direction(problem);
        for (i, link) in problem.links.iter().enumerate() {
            let first = link.first.map_or(DVec3::ZERO, |body| self.moved[body as usize]);
            let rate = (self.moved[link.second as usize] - first).dot(link.normal);
            self.image[i] = self.scales[i] * rate;
        }
    }

    fn push_along_direction(&mut self, problem: &Problem) {
        let inverse_mass = |body: usize| problem.inverse_masses[body];
        let impulse = |i: usize| self.scales[i] * self.direction[i];
        push(&problem.links, inverse_mass, impulse, &mut self.steps, &mut self.moved);
    }

    /// Length of the step along the direction to the minimum; none if it moves nothing.
    fn best_length(&mut self) -> Option<f64> {
        let Self { direction, image, gradient, terms, curvature, .. } = self;
        let mut dot = |a: &[f64], b: &[f64]| sum_of(terms, a.iter().zip(b).map(|(a, b)| a * b));
        *curvature = dot(direction, image);
        let standstill = STANDSTILL * dot(direction, direction);
        (*curvature > standstill).then(|| dot(gradient, direction) / *curvature)
    }

    /// The longest step along the direction that leaves no impulse below zero.
    fn reach(&self) -> f64 {
        let pairs = self.x.iter().zip(&self.direction);
        let lengths = pairs.map(|(x, p)| if *p > 0.0 { x / p } else { f64::INFINITY });
        lengths.fold(f64::INFINITY, |least, length| if length < least { length } else { least })
    }

    fn advance(&mut self, length: f64, velocities: &mut [DVec3]) {
        for (x, p) in self.x.iter_mut().zip(&self.direction) {
            // What the step just reaches ends at zero exactly.
            *x = if *p > 0.0 && *x / *p <= length { 0.0 } else { *x - length * p };
        }
        for (velocity, moved) in velocities.iter_mut().zip(&self.moved) {
            *velocity -= length * *moved;
        }
    }

    /// A step of fixed length along the rates of contacts with impulses; those that would fall
    /// below zero end there.
    fn project(&mut self, problem: &Problem, velocities: &mut [DVec3]) {
        for i in 0..self.x.len() {
            // Not the difference of the rounded impulses: large ones would drown small changes.
            let change = (self.step_length * free(self.x[i], self.gradient[i])).min(self.x[i]);
            self.direction[i] = change;
            self.x[i] -= change;
        }
        self.push_along_direction(problem);
        for (velocity, moved) in velocities.iter_mut().zip(&self.moved) {
            *velocity -= *moved;
        }
    }

    /// The next direction: the free gradient, made conjugate to the last direction.
    fn make_conjugate(&mut self) {
        let Self { x, gradient, direction, image, terms, curvature, .. } = self;
        let rates = || x.iter().zip(&*gradient).map(|(x, g)| free(*x, *g));
        let overlap = sum_of(terms, rates().zip(&*image).map(|(free, image)| free * image));
        let part = overlap / *curvature;
        for (direction, free) in direction.iter_mut().zip(rates()) {
            *direction = free - part * *direction;
        }
    }
}

/// Rate of a contact that has an impulse x, else zero.
fn free(x: f64, rate: f64) -> f64 {
    if x > 0.0 { rate } else { 0.0 }
}

/// Rate of a contact that closes and has no impulse, else zero.
fn closing(x: f64, rate: f64) -> f64 {
    if x > 0.0 || rate > 0.0 { 0.0 } else { rate }
}

/// The largest of the values, or zero.
fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |largest, value| if value > largest { value } else { largest })
}

/// A single contact, in closed form; gives the impulse.
fn solve_one(link: &Link, inverse_masses: &[f64], velocities: &mut [DVec3]) -> f64 {
    let rate = link.rate(velocities);
    if rate >= 0.0 {
        return 0.0;
    }
    let inverse_mass = |body: u32| inverse_masses[body as usize];
    let second = link.second as usize;
    let impulse = -rate / (inverse_masses[second] + link.first.map_or(0.0, inverse_mass));
    velocities[second] += impulse * inverse_masses[second] * link.normal;
    if let Some(first) = link.first {
        velocities[first as usize] -= impulse * inverse_mass(first) * link.normal;
    }
    impulse
}
