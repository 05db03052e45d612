//! Friction in an impact on a compliant surface.

use std::f64::consts::{FRAC_PI_2, PI};

/// Pieces of the restitution in which the end of sticking is searched. The two forces differ by a sum of two sines of
/// at most two waves each, whose zeros lie further apart.
const PIECES: u32 = 32;
/// The reversal does not depend on an incidence below this but for rounding.
const LEAST: f64 = 1e-9;
/// Halvings of a piece, after which the phase is known to rounding.
const HALVINGS: u32 = 52;
/// Changes between slipping and sticking, at most: a phase angle of π has room for two of them.
const MOST_CHANGES: u32 = 8;

/// An impact on a surface that is a spring along its normal and one across it.
///
/// The normal force is half a wave, the restitution e times as fast as the compression. The contact sticks while the
/// spring across the normal bears less than the coefficient of friction times the normal force, else it slips (Stronge,
/// Impact Mechanics, Cambridge 2000, section 5.1; Stronge, James and Ravani, Phil. Trans. R. Soc. A 359, 2447 (2001)).
#[derive(Debug, Clone, Copy)]
pub(crate) struct CompliantImpact {
    /// Tangent of the angle of incidence divided by the coefficient of friction, >= 0: the speed of slip before the
    /// impact, divided by that of approach and by the coefficient.
    pub incidence: f64,
    /// Coefficient of restitution along the normal, in \[0, 1\].
    pub restitution: f64,
    /// Velocity that a unit impulse gives the contact across the normal, divided by that along the normal.
    pub mobility_ratio: f64,
    /// Frequency of the vibration across the normal divided by that along it, in \[1, 2\].
    pub frequency_ratio: f64,
}

/// The part of the slip that an impact reverses, in [-1, 1]; negative where slip goes on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Reversal {
    pub value: f64,
    /// Derivatives by the incidence and by the restitution.
    pub by: [f64; 2],
}

/// Where an impact is at a phase of the normal force in \[0, π\].
///
/// Velocities are divided by the speed of approach, forces by the largest normal force without friction, both also by
/// the coefficient of friction. Time is counted in phases of the compression.
#[derive(Debug, Clone, Copy)]
struct State {
    phase: f64,
    /// Velocity of the contact along the surface, and its derivatives by incidence and restitution.
    velocity: f64,
    by: [f64; 2],
    /// Force of the spring across the normal.
    force: f64,
}

impl CompliantImpact {
    /// Returns the part of the slip that the impact reverses.
    pub fn reversal(&self) -> Reversal {
        if !self.incidence.is_finite() {
            return Reversal { value: 0.0, by: [0.0; 2] };
        }
        let incidence = self.incidence.max(f64::MIN_POSITIVE);
        let mut state = State { phase: 0.0, velocity: incidence, by: [1.0, 0.0], force: 0.0 };
        // The spring begins to bear faster than friction allows.
        let mut slips = self.stiffness() * incidence > 1.0;
        let mut side = 1.0;
        for _ in 0..MOST_CHANGES {
            let end = if slips { self.sticks_at(&state, side) } else { self.slips_at(&state) };
            let until = end.unwrap_or(PI);
            state = if slips { self.slipped(state, side, until) } else { self.stuck(state, until) };
            if end.is_none() {
                break;
            }
            slips = !slips;
            side = if state.force < 0.0 { -1.0 } else { 1.0 };
        }
        if state.phase < PI {
            state = self.slipped(state, side, PI);
        }
        let value = (-state.velocity / incidence).clamp(-1.0, 1.0);
        let by_incidence = -(state.by[0] + value) / incidence.max(LEAST);
        Reversal { value, by: [by_incidence, -state.by[1] / incidence] }
    }

    /// Stiffness across the normal divided by that along it.
    fn stiffness(&self) -> f64 {
        self.frequency_ratio * self.frequency_ratio / self.mobility_ratio
    }

    /// Returns the time of a phase, and the part of it in restitution, divided by the restitution.
    fn time(&self, phase: f64) -> (f64, f64) {
        let after = (phase - FRAC_PI_2).max(0.0);
        (phase.min(FRAC_PI_2) + self.restitution * after, after)
    }

    /// Returns the normal impulse up to a phase, and its derivative by the restitution.
    fn impulse(phase: f64, restitution: f64) -> (f64, f64) {
        let cosine = libm::cos(phase);
        match phase <= FRAC_PI_2 {
            true => (1.0 - cosine, 0.0),
            false => (1.0 - restitution * cosine, -cosine),
        }
    }

    /// Returns the state after a slip on which the spring bears towards this side, 1 or -1.
    fn slipped(&self, from: State, side: f64, phase: f64) -> State {
        let before = Self::impulse(from.phase, self.restitution);
        let after = Self::impulse(phase, self.restitution);
        let change = |gained: f64| -side * self.mobility_ratio * gained;
        State {
            phase,
            velocity: from.velocity + change(after.0 - before.0),
            by: [from.by[0], from.by[1] + change(after.1 - before.1)],
            force: side * libm::sin(phase),
        }
    }

    /// Returns the state after a time without slip: a vibration of the spring across the normal.
    fn stuck(&self, from: State, phase: f64) -> State {
        let (start, end) = (self.time(from.phase), self.time(phase));
        let (frequency, stiffness) = (self.frequency_ratio, self.stiffness());
        let angle = frequency * (end.0 - start.0);
        let (sine, cosine) = (libm::sin(angle), libm::cos(angle));
        let force = from.force * cosine + stiffness / frequency * from.velocity * sine;
        let velocity = from.velocity * cosine - frequency / stiffness * from.force * sine;
        // The force at the start follows from the phase, so its derivative is zero.
        let later = -self.mobility_ratio * force * (end.1 - start.1);
        State { phase, velocity, by: [from.by[0] * cosine, from.by[1] * cosine + later], force }
    }

    /// Returns the phase at which a slip ends, if it does: where the contact moves as its spring relaxes.
    fn sticks_at(&self, from: &State, side: f64) -> Option<f64> {
        let compliance = 1.0 / self.stiffness();
        let along = side * from.velocity;
        let mut at_turn = along;
        if from.phase < FRAC_PI_2 {
            let cosine = libm::cos(from.phase);
            let (rest, factor) =
                (along - self.mobility_ratio * cosine, self.mobility_ratio - compliance);
            let found = crossing(rest, factor, [from.phase, FRAC_PI_2]);
            let stops = found.or((rest <= 0.0).then_some(FRAC_PI_2));
            if stops.is_some() {
                return stops;
            }
            at_turn = rest;
        }
        let (start, restitution) = (from.phase.max(FRAC_PI_2), self.restitution);
        let pushed = self.mobility_ratio * restitution;
        let cosine = if from.phase < FRAC_PI_2 { 0.0 } else { libm::cos(start) };
        let rest = restitution * (at_turn - pushed * cosine);
        crossing(rest, restitution * pushed - compliance, [start, PI])
    }

    /// Returns the phase at which sticking ends, if it does. Both springs begin to vibrate together, the one across the
    /// normal faster, so the contact holds during the compression.
    fn slips_at(&self, from: &State) -> Option<f64> {
        let start = from.phase.max(FRAC_PI_2);
        let holds = |phase: f64| self.stuck(*from, phase).force.abs() <= libm::sin(phase);
        let piece = (PI - start) / f64::from(PIECES);
        let mut ends = (1..=PIECES).map(|number| start + piece * f64::from(number));
        let mut high = ends.find(|&end| !holds(end))?;
        let mut low = high - piece;
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if holds(middle) { low = middle } else { high = middle }
        }
        Some(high.min(PI))
    }
}

/// Returns the phase in a range of at most a quarter of a wave at which `rest + factor cos(phase)` falls to zero, if it
/// does.
fn crossing(rest: f64, factor: f64, [start, end]: [f64; 2]) -> Option<f64> {
    let cosine = -rest / factor;
    // A sum that falls with the phase falls with the cosine.
    (factor > 0.0 && cosine.abs() <= 1.0)
        .then(|| libm::acos(cosine))
        .filter(|phase| (start..=end).contains(phase))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivatives_are_those_of_differences() {
        let step = 1e-5;
        for ratio in [1.05, 1.4, 1.7, 2.0] {
            for [incidence, restitution] in
                [[0.2, 0.9], [1.1, 0.6], [2.0, 0.8], [2.6, 0.85], [3.9, 0.95], [0.7, 0.1]]
            {
                let impact = CompliantImpact {
                    incidence,
                    restitution,
                    mobility_ratio: 3.5,
                    frequency_ratio: ratio,
                };
                let at = |incidence: f64, restitution: f64| {
                    CompliantImpact { incidence, restitution, ..impact }.reversal().value
                };
                let by_incidence =
                    at(incidence + step, restitution) - at(incidence - step, restitution);
                let by_restitution =
                    at(incidence, restitution + step) - at(incidence, restitution - step);
                let found = impact.reversal().by;
                let off = [by_incidence, by_restitution].map(|it| it / (2.0 * step));
                // Differences are off by the square of the step, and by the searched phase over it.
                let is_close = (found[0] - off[0]).abs().max((found[1] - off[1]).abs()) < 1e-7;
                assert!(is_close, "{impact:?}: {found:?} instead of {off:?}");
            }
        }
    }
}
