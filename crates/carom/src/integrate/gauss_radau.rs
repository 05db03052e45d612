//! Steps of 15th order under any forces: Gauss-Radau quadrature with its own control of the step.
//!
//! Source: Everhart, in *Dynamics of Comets* (1985), 185; Rein and Spiegel, MNRAS 446, 1424 (2015), IAS15. The
//! acceleration is a polynomial through its values at eight nodes of a step. The step is a good one where its
//! highest term is small.

use glam::DVec3;

use super::field::{Field, Start, Values};
use super::implicit;
use super::interpolate::{Value, through};
use super::radau_tables::{GAINS, GAINS_AT_END, Gains, NEWTON, RECIPROCALS};
use crate::norm::Norm;
use crate::polynomial_flight::{PolynomialAcceleration, TERMS};

pub(crate) use super::radau_tables::NODES;

/// The highest term of the acceleration is at most this part of it. The path between the nodes is then good to
/// rounding: their polynomial leaves less than 1e-4 of the term after the highest, which is a tenth of that, and that
/// moves the path by a hundredth.
const TOLERANCE: f64 = 1e-8;
/// A term is negligible if it changes a velocity by less than this part, since it moves the path by a
/// ten-thousandth of that.
const VELOCITY_PART: f64 = 1e-3;
/// A term is negligible if it changes a position by less than this part of the effect of rounding on forces.
const POSITION_PART: f64 = 2e-3;
/// Largest accepted ratio of the highest term of a step to the tolerance; a step above it is tried again.
const ACCEPTED: f64 = 8.0;
/// Part of the estimated step that is taken, for safety.
const SAFETY: f64 = 0.9;
/// Largest factor by which the length changes from step to step, up or down.
const MOST_GROWTH: f64 = 4.0;
const MOST_SHRINKAGE: f64 = 0.1;
/// Largest number of iterations for the values at the nodes. Steps that are short enough take three to eight.
const MAX_ITERATIONS: u32 = 12;
/// Iterations whose changes say nothing of convergence: where forces depend on velocities, the first one leaves an error
/// in the highest term as large as its change, which the second one removes.
const FIRST_ITERATIONS: u32 = 2;
/// The iteration has converged when the highest term changes by less than this part.
const CONVERGED: f64 = 1e-16;
/// An iteration whose changes stay above this part has not converged.
const DIVERGED: f64 = 1e-10;
/// Variation of forces over a step, as a part of them, below which nothing is known of their rate of change.
const STEADY: f64 = 1e-12;
/// Where no step is short enough, the force jumps: a step of this part of the last accurate one crosses the jump.
const SHORTEST: f64 = 1e-12;
/// Growth of a step over the last one, where both cross a jump of the force.
const LEAP: f64 = 8.0;
/// Part of the longest step across jumps down to which an accurate one is tried after it.
const SMALLEST_PART: f64 = 1.0 / 64.0;

/// Estimates for the next step of some spheres.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Pace {
    /// Length of the step to try next \[s\].
    pub trial: f64,
    /// A step this short is taken, whatever its error \[s\].
    pub shortest: f64,
}

impl Pace {
    /// The estimate where only a time \[s\] is known in which the spheres hardly move.
    pub fn of(time: f64) -> Self {
        Self { trial: time, shortest: SHORTEST * time }
    }

    /// The estimate after a step of this length \[s\], an accurate one or one across a jump. With jumps everywhere,
    /// steps grow up to `rough` \[s\].
    fn after(self, length: f64, is_good: bool, rough: f64) -> Self {
        let shortest = if is_good {
            // It shrinks slowly: towards a jump accurate steps become ever shorter.
            (SHORTEST * length).max(0.5 * self.shortest)
        } else if length < rough {
            (LEAP * length).min(rough)
        } else {
            // Forces may be smooth again.
            SMALLEST_PART * rough
        };
        Self { trial: self.trial.max(shortest), shortest }
    }
}

/// A step of some spheres.
#[derive(Debug, Clone)]
pub(crate) struct Step {
    /// When it ends, on the world's clock \[s\].
    pub end: f64,
    /// Acceleration of each sphere.
    pub accelerations: Vec<PolynomialAcceleration>,
    pub pace: Pace,
    /// Whether its error is small; else no shorter step was allowed.
    pub is_accurate: bool,
}

/// Takes one step. What went before, if it is known, gives the first guess.
pub(crate) fn step(
    start: &Start,
    before: Option<&[PolynomialAcceleration]>,
    mut pace: Pace,
    field: &mut impl Field,
) -> Step {
    let count = start.positions.len();
    let mut first = Values::of(count);
    field.evaluate(start.time, start.positions, start.velocities, &mut first);
    // The clock has to move on by more than its rounding.
    let least = 64.0 * f64::EPSILON * start.time.abs();
    let rough = start.rough.max(least);
    let shortest = pace.shortest.clamp(least, rough);
    loop {
        let is_shortest = pace.trial <= shortest;
        let end = (start.time + pace.trial.max(least)).min(start.until);
        let end = end.max(start.time.next_up());
        let length = end - start.time;
        let mut attempt = Attempt::new(start, &first, length, before);
        let has_converged = attempt.iterate(field);
        let mut error = if has_converged { attempt.error(field) } else { f64::INFINITY };
        if error == f64::INFINITY
            && let Some(other) = implicit::attempt(start, &first, length, field)
        {
            (attempt.powers, error) = (other.powers, other.error);
        }
        let is_good = error <= ACCEPTED * TOLERANCE;
        if is_good || is_shortest || !first.is_finite() {
            if error == f64::INFINITY {
                attempt.hold();
            }
            let is_cut = end >= start.until;
            let ratio = growth(error).min(MOST_GROWTH);
            let mut trial = if is_good { ratio * length } else { length };
            if attempt.is_steady() {
                trial = trial.min(start.steady.max(length));
            }
            if is_cut {
                trial = trial.max(pace.trial);
            }
            let pace = Pace { trial, ..pace }.after(length, is_good, rough);
            let accelerations = attempt.into_accelerations();
            return Step { end, accelerations, pace, is_accurate: is_good };
        }
        pace.trial = (length * growth(error).clamp(MOST_SHRINKAGE, SAFETY)).max(shortest);
    }
}

/// Returns the factor by which a step with this error may be longer: the error grows with the
/// seventh power of its length.
fn growth(error: f64) -> f64 {
    if error == 0.0 {
        return MOST_GROWTH;
    }
    let growth = SAFETY * libm::pow(TOLERANCE / error, 1.0 / 7.0);
    if growth.is_finite() { growth } else { 0.0 }
}

/// A step of some length that is tried.
struct Attempt<'a> {
    start: &'a Start<'a>,
    /// Accelerations at the beginning \[m/s²\].
    first: &'a Values,
    /// \[s\]
    length: f64,
    /// Acceleration of each sphere as a sum of products of nodes \[m/s²\].
    newton: Vec<[DVec3; TERMS]>,
    /// The same as a sum of powers \[m/s²\].
    powers: Vec<[DVec3; TERMS]>,
    /// Sizes of the accelerations of each sphere, at most \[m/s²\].
    sizes: Vec<f64>,
}

impl<'a> Attempt<'a> {
    fn new(
        start: &'a Start,
        first: &'a Values,
        length: f64,
        before: Option<&[PolynomialAcceleration]>,
    ) -> Self {
        let powers: Vec<[DVec3; TERMS]> = first
            .accelerations
            .iter()
            .enumerate()
            .map(|(sphere, &acceleration)| {
                let mut powers =
                    before.map_or([DVec3::ZERO; TERMS], |it| it[sphere].continued(length));
                powers[0] = acceleration;
                powers
            })
            .collect();
        let newton = powers.iter().map(newton_form).collect();
        Self { start, first, length, newton, powers, sizes: first.sizes.clone() }
    }

    /// Finds the accelerations at the nodes by iteration; returns whether it converges.
    fn iterate(&mut self, field: &mut impl Field) -> bool {
        let count = self.powers.len();
        let (mut positions, mut velocities) = (vec![DVec3::ZERO; count], vec![DVec3::ZERO; count]);
        let mut values = Values::of(count);
        let mut change_before = f64::INFINITY;
        for iteration in 0..MAX_ITERATIONS {
            let mut change = 0.0f64;
            for (node, &s) in NODES.iter().enumerate().skip(1) {
                self.states_at(s, &GAINS[node], [&mut positions, &mut velocities]);
                let time = self.start.time + s * self.length;
                field.evaluate(time, &positions, &velocities, &mut values);
                change = self.take_in(node, &values);
            }
            if !change.is_finite() {
                return false;
            }
            if change <= CONVERGED {
                return true;
            }
            if iteration >= FIRST_ITERATIONS && change >= change_before {
                return change <= DIVERGED;
            }
            change_before = change;
        }
        change_before <= DIVERGED
    }

    /// Computes the positions and velocities of the spheres at a part of the step.
    fn states_at(&self, s: f64, gains: &Gains, [positions, velocities]: [&mut [DVec3]; 2]) {
        for (sphere, powers) in self.powers.iter().enumerate() {
            [positions[sphere], velocities[sphere]] =
                self.start.state_at(sphere, (s, self.length), (powers, gains));
        }
    }

    /// Adds the accelerations at a node; returns by what part that changes the term of this node,
    /// if it is the last.
    fn take_in(&mut self, node: usize, values: &Values) -> f64 {
        let is_last = node == TERMS - 1;
        let mut most = 0.0f64;
        for sphere in 0..self.powers.len() {
            let acceleration = values.accelerations[sphere];
            let size = self.sizes[sphere].max(values.sizes[sphere]);
            self.sizes[sphere] = size;
            let mut term = (acceleration - self.first.accelerations[sphere]) * RECIPROCALS[node][0];
            let before = RECIPROCALS[node].iter().zip(&self.newton[sphere]).take(node).skip(1);
            for (reciprocal, known) in before {
                term = (term - *known) * *reciprocal;
            }
            let change = term - self.newton[sphere][node];
            self.newton[sphere][node] = term;
            for (power, factor) in
                self.powers[sphere].iter_mut().zip(&NEWTON[node]).skip(1).take(node)
            {
                *power += *factor * change;
            }
            if !change.is_finite() {
                return f64::INFINITY;
            }
            if is_last && change != DVec3::ZERO {
                most = most.max(change.norm() / size);
            }
        }
        most
    }

    /// The highest term as a part of what it is measured by, of the sphere where that is largest; or how far the
    /// polynomial is from the acceleration at the end, where no node is.
    fn error(&self, field: &mut impl Field) -> f64 {
        let count = self.powers.len();
        let (mut positions, mut velocities) = (vec![DVec3::ZERO; count], vec![DVec3::ZERO; count]);
        let mut values = Values::of(count);
        self.states_at(1.0, &GAINS_AT_END, [&mut positions, &mut velocities]);
        field.evaluate(self.start.time + self.length, &positions, &velocities, &mut values);
        let mut most = 0.0f64;
        for (sphere, powers) in self.powers.iter().enumerate() {
            let last = powers[TERMS - 1].norm();
            let end: DVec3 = powers.iter().sum();
            let missed = (values.accelerations[sphere] - end).norm();
            if !(last.is_finite() && missed.is_finite()) {
                return f64::INFINITY;
            }
            let size = self.size_at(sphere, [positions[sphere], velocities[sphere]]);
            let error = last.max(missed);
            most = if error == 0.0 { most } else { most.max(error / size) };
        }
        most
    }

    /// What the error of a sphere is measured by \[m/s²\], which is at one of the ends of the step there \[m\], with
    /// this velocity \[m/s\].
    fn size_at(&self, sphere: usize, [position, velocity]: [DVec3; 2]) -> f64 {
        let (h, start) = (self.length, self.start);
        let speed = start.velocities[sphere].norm().max(velocity.norm());
        let place = start.positions[sphere].norm().max(position.norm());
        self.sizes[sphere] + VELOCITY_PART * speed / h + POSITION_PART * place / h / h
    }

    /// Takes the accelerations at the beginning for those of all the step.
    fn hold(&mut self) {
        for (powers, &acceleration) in self.powers.iter_mut().zip(&self.first.accelerations) {
            *powers = [DVec3::ZERO; TERMS];
            powers[0] = acceleration;
        }
    }

    /// Whether the accelerations hardly vary.
    fn is_steady(&self) -> bool {
        self.powers.iter().zip(&self.sizes).all(|(powers, size)| {
            let varying: f64 = powers[1..].iter().map(|c| c.norm()).sum();
            varying <= STEADY * size
        })
    }

    fn into_accelerations(self) -> Vec<PolynomialAcceleration> {
        let length = self.length;
        let of =
            |(coefficients, &carried)| PolynomialAcceleration { length, coefficients, carried };
        self.powers.into_iter().zip(self.start.carried).map(of).collect()
    }
}

/// The polynomial with these values at the nodes, as a sum of powers of the part of the step.
pub(crate) fn through_nodes<T: Value>(values: [T; TERMS]) -> [T; TERMS] {
    through(&NODES, &NEWTON, values)
}

/// A sum of powers as one of products of nodes: repeated division by `s - h_n`, with the remainders.
fn newton_form(powers: &[DVec3; TERMS]) -> [DVec3; TERMS] {
    let mut terms = *powers;
    for (first, node) in NODES.into_iter().enumerate().skip(1) {
        for k in (first..TERMS - 1).rev() {
            let higher = terms[k + 1];
            terms[k] += node * higher;
        }
    }
    terms
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::polynomial_flight::ORDERS;

    /// `x'' = -x` for each component.
    struct Oscillator;

    impl Field for Oscillator {
        fn evaluate(&mut self, _: f64, positions: &[DVec3], _: &[DVec3], at: &mut Values) {
            at.accelerations[0] = -positions[0];
            at.sizes[0] = positions[0].norm();
        }
    }

    fn steps(until: f64) -> (DVec3, DVec3, u32) {
        let (mut position, mut velocity, mut time) = (DVec3::X, DVec3::Y, 0.0);
        let (mut pace, mut before, mut count) = (Pace::of(0.01), None, 0);
        while time < until {
            let (positions, velocities, carried) = ([position], [velocity], [[DVec3::ZERO; 2]]);
            let start = Start {
                positions: &positions,
                velocities: &velocities,
                carried: &carried,
                time,
                until,
                steady: 1.0,
                rough: 1.0,
            };
            let step = step(&start, before.as_deref(), pace, &mut Oscillator);
            let (way, change) = step.accelerations[0].gained_until(step.end - time);
            position += (step.end - time) * velocity + way;
            velocity += change;
            (time, pace, before) = (step.end, step.pace, Some(step.accelerations));
            count += 1;
        }
        (position, velocity, count)
    }

    #[test]
    fn a_circle_closes_to_rounding_in_few_steps() {
        let (position, velocity, count) = steps(std::f64::consts::TAU * 10.0);
        // Some hundred steps, each of which rounds at 1e-16 and adds to the phase.
        assert!((position - DVec3::X).length() < 1e-13, "{position}");
        assert!((velocity - DVec3::Y).length() < 1e-13, "{velocity}");
        assert!(count < 600, "{count}");
    }

    /// `x'' = -x'` for each component.
    struct Drag;

    impl Field for Drag {
        fn evaluate(&mut self, _: f64, _: &[DVec3], velocities: &[DVec3], at: &mut Values) {
            at.accelerations[0] = -velocities[0];
            at.sizes[0] = velocities[0].norm();
        }
    }

    #[test]
    fn a_first_step_under_drag_is_as_long_as_it_is_accurate() {
        for length in [0.1, 0.01, 0.001] {
            let start = Start {
                positions: &[DVec3::ZERO],
                velocities: &[DVec3::X],
                carried: &[[DVec3::ZERO; 2]],
                time: 0.0,
                until: 1.0,
                steady: 1.0,
                rough: 1.0,
            };
            let step = step(&start, None, Pace::of(length), &mut Drag);
            assert_eq!(step.end, length);
            let velocity = DVec3::X + step.accelerations[0].gained_until(length).1;
            // Rounding of the sum.
            assert!((velocity.x - libm::exp(-length)).abs() < 1e-15, "{length}: {velocity}");
        }
    }

    #[test]
    fn forms_of_a_polynomial_agree() {
        let mut powers = [DVec3::ZERO; TERMS];
        powers.iter_mut().zip(ORDERS).for_each(|(power, k)| *power = DVec3::splat(1.0 - 0.3 * k));
        let newton = newton_form(&powers);
        for k in 0..TERMS {
            let back: DVec3 = (0..TERMS).map(|n| NEWTON[n][k] * newton[n]).sum();
            // Rounding of eight terms of size 10.
            assert!((back - powers[k]).length() < 1e-13, "{k}");
        }
    }
}
