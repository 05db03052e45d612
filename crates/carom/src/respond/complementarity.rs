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
use super::order_free::{self, Grid};

/// One contact of a problem: what its impulse moves, and the rate it asks for.
#[derive(Debug, Clone, Copy)]
pub(super) struct Link {
    /// Body 1, pushed against the normal; none for a surface.
    pub first: Option<u32>,
    /// Body 2, pushed along the normal.
    pub second: u32,
    /// Unit vector from 1 to 2.
    pub normal: DVec3,
    /// Velocity of the surface, where there is no body 1.
    pub surface_velocity: DVec3,
    /// The rate of opening that counts as zero.
    pub target: f64,
}

impl Link {
    /// Rate of opening above the target.
    pub fn rate(&self, velocities: &[DVec3]) -> f64 {
        let first = self.first.map_or(self.surface_velocity, |body| velocities[body as usize]);
        (velocities[self.second as usize] - first).dot(self.normal) - self.target
    }
}

/// Contacts and the bodies they move.
#[derive(Debug, Clone, Default)]
pub(super) struct Problem {
    pub links: Vec<Link>,
    /// One per body, relative to some common mass.
    pub inverse_masses: Vec<f64>,
}

/// Rates of opening that are told apart from zero.
#[derive(Debug, Clone, Copy)]
pub(super) struct Tolerance {
    /// Below this nothing is gained by going on.
    pub fine: f64,
    /// Below this it may be rounding, and is left where going on gains nothing.
    pub coarse: f64,
}

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

/// Iterations, per contact and besides, of the quick method. Conjugate gradients on exact numbers
/// need one for each contact of the final face.
const QUICK: usize = 50;
const QUICK_PER_LINK: usize = 4;

/// Iterations, per contact and besides, of the careful method, which ends by itself but may go
/// through many faces; and a bound of iterations times contacts, some seconds' work.
const CAREFUL: usize = 100;
const CAREFUL_PER_LINK: usize = 50;
const CAREFUL_WORK: usize = 10_000_000;

/// Contacts up to which the careful method solves directly, in memory and time that grow with
/// the square and cube of their number; beyond, by conjugate gradients.
const DIRECT: usize = 200;

/// Part of the norm of A's bound that a step of fixed length takes; must be below 2, and is best
/// close to it (Dostál, "Optimal Quadratic Programming Algorithms", 2009, section 5.9).
const STEP_LENGTH: f64 = 1.9;

/// Iterations without progress after which a solution within the coarse tolerance is taken.
const PATIENCE: usize = 4;

/// What is done where a step would take an impulse below zero.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Leaving {
    /// A step of fixed length follows, cut off at zero: many impulses may end at once.
    Projected,
    /// It ends there; other contacts are taken up only once all that have impulses are right.
    Stopped,
}

/// Working memory of [`Solver::solve`].
///
/// First, modified proportioning with reduced gradient projections (Dostál and Schöberl, "Minimizing
/// quadratic functions over non-negative cone with the rate of convergence and finite
/// termination", Comput. Optim. Appl. 30, 2005): conjugate gradients among the contacts with
/// impulses, projected steps where an impulse would fall below zero, and gradient steps that
/// take up contacts that close. Where that is slow, because masses differ much, the older method
/// of faces (Polyak, "The conjugate gradient method in extremal problems", USSR Comput. Math.
/// Math. Phys. 9, 1969), which ends after finitely many faces whatever the masses. The graph of
/// contacts is all that is needed of A.
///
/// Everything is done to all contacts alike or is a sum that does not depend on the order
/// ([`Grid`]), so mirrored or renumbered problems give mirrored or renumbered solutions to the
/// last bit. The gradient is measured anew on the velocities in every iteration, which keeps
/// them right even where large impulses on a light body nearly cancel.
#[derive(Debug, Clone, Default)]
pub(super) struct Solver {
    /// Power of two near `1/√A_ii`, which evens out masses without rounding anything.
    scales: Vec<f64>,
    /// Scaled impulses and rates, one per contact.
    x: Vec<f64>,
    gradient: Vec<f64>,
    direction: Vec<f64>,
    /// A times the direction, as rates of contacts and as velocities of bodies.
    image: Vec<f64>,
    moved: Vec<DVec3>,
    steps: Vec<[i128; 3]>,
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
        tolerance: Tolerance,
        velocities: &mut [DVec3],
        impulses: &mut Vec<f64>,
    ) -> Outcome {
        impulses.clear();
        let outcome = if let [link] = problem.links[..] {
            impulses.push(solve_one(&link, &problem.inverse_masses, velocities));
            Outcome::Solved
        } else {
            self.prepare(problem);
            let outcome = self.iterate(problem, tolerance, velocities);
            impulses.extend(self.x.iter().zip(&self.scales).map(|(x, scale)| x * scale));
            outcome
        };
        outcome
    }

    fn iterate(
        &mut self,
        problem: &Problem,
        tolerance: Tolerance,
        velocities: &mut [DVec3],
    ) -> Outcome {
        let links = problem.links.len();
        let careful = (CAREFUL + CAREFUL_PER_LINK * links).min(CAREFUL_WORK / links.max(1));
        self.measure(problem, tolerance, velocities);
        let quick = QUICK + QUICK_PER_LINK * links;
        let outcome = self.descend(problem, tolerance, velocities, Leaving::Projected, quick);
        if outcome != Outcome::Unfinished {
            return outcome;
        }
        let o = self.descend(problem, tolerance, velocities, Leaving::Stopped, careful);
        if std::env::var("DBG").is_ok() {
            eprintln!(
                "T {o:?} viol={:e} tol={:e} x={:?} g={:?} s={:?}",
                self.violation(),
                tolerance.coarse,
                self.x,
                self.gradient,
                self.scales
            );
        }
        o
    }

    fn descend(
        &mut self,
        problem: &Problem,
        tolerance: Tolerance,
        velocities: &mut [DVec3],
        leaving: Leaving,
        bound: usize,
    ) -> Outcome {
        let direct = leaving == Leaving::Stopped && problem.links.len() <= DIRECT;
        let mut best = f64::INFINITY;
        let mut without_progress = 0;
        // Whether the direction is already the one to go on with.
        let mut conjugate = false;
        for _ in 0..bound {
            let violation = self.violation();
            if violation < best {
                (best, without_progress) = (violation, 0);
            } else {
                without_progress += 1;
            }
            let stalled = violation <= tolerance.coarse && without_progress > PATIENCE;
            if violation <= tolerance.fine || stalled {
                return Outcome::Solved;
            }
            let on_face = self.stays_on_face(leaving);
            if !on_face {
                self.direction_of_closing();
            } else if direct {
                self.direction_to_minimum(problem);
            } else if !conjugate {
                self.direction_of_free();
            }
            self.apply(problem);
            let Some(length) = self.best_length() else {
                let solved = violation <= tolerance.coarse;
                return if solved { Outcome::Solved } else { Outcome::Jammed };
            };
            let reach = self.reach();
            self.advance(length.min(reach), velocities);
            self.measure(problem, tolerance, velocities);
            conjugate = on_face && length <= reach;
            if conjugate && !direct {
                self.make_conjugate();
            } else if on_face && length > reach && leaving == Leaving::Projected {
                self.project(problem, velocities);
                self.measure(problem, tolerance, velocities);
            }
        }
        if self.violation() <= tolerance.coarse { Outcome::Solved } else { Outcome::Unfinished }
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
        for array in [&mut self.x, &mut self.gradient, &mut self.direction, &mut self.image] {
            array.clear();
            array.resize(links, 0.0);
        }
        self.moved.clear();
        self.moved.resize(bodies, DVec3::ZERO);
        self.steps.clear();
        self.steps.resize(bodies, [0; 3]);
        self.face.clear();
        self.step_length = STEP_LENGTH / self.norm_bound(problem);
    }

    /// A bound of the norm of the scaled A, by the sums of its rows (Gershgorin).
    fn norm_bound(&self, problem: &Problem) -> f64 {
        let mut most = vec![(0.0, 0.0_f64); problem.inverse_masses.len()];
        for (link, &scale) in problem.links.iter().zip(&self.scales) {
            for body in link.first.into_iter().chain([link.second]) {
                let (count, largest) = &mut most[body as usize];
                *count += 1.0;
                *largest = scale.max(*largest);
            }
        }
        let row = |(link, scale): (&Link, &f64)| {
            let part = |body: u32| {
                let (count, largest) = most[body as usize];
                problem.inverse_masses[body as usize] * count * largest
            };
            scale * (part(link.second) + link.first.map_or(0.0, part))
        };
        problem.links.iter().zip(&self.scales).map(row).fold(0.0, f64::max)
    }

    /// The gradient: scaled rates of opening. Those below the fine tolerance count as zero: to
    /// follow their rounding would disturb contacts at lighter bodies.
    fn measure(&mut self, problem: &Problem, tolerance: Tolerance, velocities: &[DVec3]) {
        for (i, link) in problem.links.iter().enumerate() {
            let rate = link.rate(velocities);
            let told_apart = rate.abs() > tolerance.fine;
            self.gradient[i] = if told_apart { self.scales[i] * rate } else { 0.0 };
        }
    }

    /// By how much rates miss the conditions, at worst.
    fn violation(&self) -> f64 {
        let missed = |(i, g): (usize, &f64)| {
            let missed = if self.x[i] > 0.0 { g.abs() } else { (-g).max(0.0) };
            missed / self.scales[i]
        };
        self.gradient.iter().enumerate().map(missed).fold(0.0, f64::max)
    }

    /// Rate of a contact that has an impulse, else zero.
    fn free(&self, i: usize) -> f64 {
        if self.x[i] > 0.0 { self.gradient[i] } else { 0.0 }
    }

    /// Rate of a contact that closes and has no impulse, else zero.
    fn closing(&self, i: usize) -> f64 {
        if self.x[i] > 0.0 { 0.0 } else { self.gradient[i].min(0.0) }
    }

    /// Whether to go on among contacts with impulses rather than to take up others: as long as
    /// more is to be gained there, or anything.
    fn stays_on_face(&self, leaving: Leaving) -> bool {
        let count = self.x.len();
        let free = order_free::sum((0..count).map(|i| {
            let reduced = match leaving {
                Leaving::Projected => self.free(i).min(self.x[i] / self.step_length),
                Leaving::Stopped => self.free(i),
            };
            reduced * self.free(i)
        }));
        let closing = order_free::sum((0..count).map(|i| self.closing(i) * self.closing(i)));
        match leaving {
            Leaving::Projected => closing <= free,
            Leaving::Stopped => free > 0.0,
        }
    }

    fn direction_of_closing(&mut self) {
        for i in 0..self.x.len() {
            self.direction[i] = self.closing(i);
        }
    }

    fn direction_to_minimum(&mut self, problem: &Problem) {
        let Self { face, x, scales, gradient, direction, .. } = self;
        face.set(problem, scales, |contact| x[contact] > 0.0);
        face.solve(gradient, direction);
    }

    fn direction_of_free(&mut self) {
        for i in 0..self.x.len() {
            self.direction[i] = self.free(i);
        }
    }

    /// What impulses along the direction do to bodies and rates.
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
    fn best_length(&self) -> Option<f64> {
        let dot = |a: &[f64], b: &[f64]| order_free::sum(a.iter().zip(b).map(|(a, b)| a * b));
        let curvature = dot(&self.direction, &self.image);
        let standstill = STANDSTILL * dot(&self.direction, &self.direction);
        (curvature > standstill).then(|| dot(&self.gradient, &self.direction) / curvature)
    }

    /// The longest step along the direction that leaves no impulse below zero.
    fn reach(&self) -> f64 {
        let pairs = self.x.iter().zip(&self.direction);
        let lengths = pairs.map(|(x, p)| if *p > 0.0 { x / p } else { f64::INFINITY });
        lengths.fold(f64::INFINITY, f64::min)
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
            let change = (self.step_length * self.free(i)).min(self.x[i]);
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
        let count = self.x.len();
        let overlap = order_free::sum((0..count).map(|i| self.free(i) * self.image[i]));
        let curvature = order_free::sum((0..count).map(|i| self.direction[i] * self.image[i]));
        let part = overlap / curvature;
        for i in 0..count {
            self.direction[i] = self.free(i) - part * self.direction[i];
        }
    }
}

/// Velocities `M⁻¹ N x` that impulses give to bodies at rest.
///
/// The impulses are added on a grid: to no order, and as much to one body as from the other.
pub(super) fn push(
    links: &[Link],
    inverse_mass: impl Fn(usize) -> f64,
    impulse: impl Fn(usize) -> f64,
    steps: &mut [[i128; 3]],
    moved: &mut [DVec3],
) {
    let count = links.len();
    let largest = (0..count).map(|i| impulse(i).abs()).fold(0.0, f64::max);
    let grid = Grid::new(largest, count);
    steps.fill([0; 3]);
    for (i, link) in links.iter().enumerate() {
        let given = (impulse(i) * link.normal).to_array().map(|part| grid.steps(part));
        for (axis, given) in given.into_iter().enumerate() {
            let second = &mut steps[link.second as usize][axis];
            *second = second.wrapping_add(given);
            if let Some(first) = link.first {
                let first = &mut steps[first as usize][axis];
                *first = first.wrapping_sub(given);
            }
        }
    }
    for (body, moved) in moved.iter_mut().enumerate() {
        let momentum = DVec3::from_array(steps[body].map(|steps| grid.value(steps)));
        *moved = inverse_mass(body) * momentum;
    }
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
