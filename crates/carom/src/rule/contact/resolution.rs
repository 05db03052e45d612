//! How finely time is cut: sub-steps short enough for what forces and turning surfaces do in one.

use super::solver::Solver;

/// In a sub-step of the length h, what accelerates with a from rest goes by h² a: by no more than the square of
/// this part of its radius.
const FALL: f64 = 0.25;
/// A surface turns by no more than this angle in a sub-step \[rad\].
pub(crate) const TURN: f64 = 0.25;
/// Sub-steps are halved so often at most.
const MOST_HALVINGS: u32 = 6;

/// Finds in how many sub-steps a frame of this length \[s\] is cut: so many, or twice, four times, ... as many.
pub(super) fn sub_steps(solver: &Solver, least: u32, frame: f64) -> u32 {
    let slots = &solver.slots;
    let both = slots.acceleration.iter().zip(&slots.position);
    let rates = both.map(|(row, place)| row.vector().length() / place.number());
    let fall = rates.fold(0.0, f64::max).sqrt() / FALL;
    let turn = solver.places.turning_rate() / TURN;
    let mut number = least;
    for _ in 0..MOST_HALVINGS {
        if frame * fall.max(turn) <= f64::from(number) {
            break;
        }
        number = number.saturating_mul(2);
    }
    number
}
