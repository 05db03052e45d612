//! Number of sub-steps: short enough for the changes by forces, springs and turning surfaces in one.

use glam::DVec3;

use super::slots::Slots;
use super::solver::Solver;

/// In a sub-step of the length h, a sphere that accelerates with a from rest moves by h² a: at most the square of
/// this part of its radius.
const FALL: f64 = 0.25;
/// A surface turns by no more than this angle in a sub-step \[rad\].
pub(crate) const TURN: f64 = 0.25;
/// In a periodic box no sphere goes farther in a sub-step than this part of its shortest edge, beside the mean motion.
const OF_BOX: f64 = 0.125;
/// The fastest motion on springs turns by no more than this angle in a sub-step \[rad\]: the scheme is stable up to 2
/// (Hairer, Lubich, Wanner, *Geometric Numerical Integration*, I.5.2).
const SWING: f64 = 1.0;
/// A box is sheared by no more than this in a sub-step.
const STRAIN: f64 = 1.0 / 32.0;
/// Largest number of halvings of sub-steps.
const MOST_HALVINGS: u32 = 6;

/// Returns the number of sub-steps of a frame of this length \[s\], with the rate of motion on springs \[1/s\]: the
/// number of the parameters, or twice, four times, ... as many.
pub(super) fn sub_steps(solver: &Solver, least: u32, frame: f64, spring_rate: f64) -> u32 {
    let slots = &solver.slots;
    let both = slots.acceleration.iter().zip(&slots.position);
    let rates = both.map(|(row, place)| row.vector().length() / place.number());
    let fall = rates.fold(0.0, f64::max).sqrt() / FALL;
    let turn = solver.places.turning_rate() / TURN;
    let across = fastest_beside(slots) / (OF_BOX * slots.period.min_element());
    let strain = slots.shear.map_or(0.0, |shear| shear.rate.abs()) / STRAIN;
    let most = fall.max(turn).max(across).max(spring_rate / SWING).max(strain);
    let mut number = least;
    for _ in 0..MOST_HALVINGS {
        if frame * most <= f64::from(number) {
            break;
        }
        number = number.saturating_mul(2);
    }
    number
}

/// Returns the longest frame \[s\] for which the sub-steps can follow springs with this rate of motion \[1/s\]; `least`
/// is the number of sub-steps of the parameters.
pub(crate) fn longest_frame_for_springs(least: u32, spring_rate: f64) -> f64 {
    SWING / spring_rate * f64::from(least) * f64::from(1u32 << MOST_HALVINGS)
}

/// The highest speed beside the mean flow \[m/s\]; 0 where space is not periodic.
fn fastest_beside(slots: &Slots) -> f64 {
    if slots.period == DVec3::INFINITY || slots.len() == 0 {
        return 0.0;
    }
    let velocities = || (0..slots.len()).map(|slot| slots.beside_flow(slot));
    let mean = velocities().sum::<DVec3>() / slots.len() as f64;
    velocities().map(|it| (it - mean).length()).fold(0.0, f64::max)
}
