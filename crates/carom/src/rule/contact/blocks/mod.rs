//! Blocks: where a sphere bears a much heavier one, the contacts about the heavy one are solved together.
//!
//! A sweep gives a contact the impulse that its effective mass needs, which is that of the lighter sphere. So the
//! weight of a heavy sphere comes through a light one in about as many sweeps as the masses differ. A block is the
//! contacts of a heavy sphere and of the lighter ones under it, down to what they lie on: few equations, solved to
//! rounding.

mod block;
mod equations;

use block::{Block, has_uneven_masses, heavy_spheres};

use super::solver::Solver;
use super::sub_step::SubStep;

/// Errors of velocities below this part of the change by forces in a sub-step are left.
const SOLVED: f64 = 1e-9;

/// Solves the blocks of a sub-step that the sweeps left unsolved, each with the impulses of all other contacts as
/// they are.
pub(super) fn solve(solver: &mut Solver, sub_step: &SubStep) {
    if !has_uneven_masses(solver) {
        return;
    }
    solver.incidence.renew(&solver.slabs, solver.slots.len());
    let tolerance = SOLVED * sub_step.growth;
    for heavy in heavy_spheres(solver) {
        let Some(mut block) = Block::about(solver, heavy) else { continue };
        if block.solve(tolerance) {
            block.write(solver);
        }
    }
}
