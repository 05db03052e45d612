//! Positions follow the velocities.

use super::slots::Slots;
use super::solver::Solver;
use super::sub_step::SubStep;
use super::surfaces;
use crate::system::System;

/// Moves spheres and surfaces over the sub-step. No sphere leaves the margin within which its neighbours
/// are known: one that an impact has made so fast is late by the rest of its way.
pub(super) fn advance(system: &System, solver: &mut Solver, sub_step: &SubStep) {
    let Slots { position, velocity, reference, spin, turn, .. } = &mut solver.slots;
    for (slot, position) in position.iter_mut().enumerate() {
        let end = position.vector() + sub_step.h * velocity[slot].vector();
        let origin = reference[slot].vector();
        let (way, margin) = (end - origin, reference[slot].number());
        let length_squared = way.length_squared();
        let is_near = length_squared <= margin * margin;
        let end = if is_near { end } else { origin + way * (margin / length_squared.sqrt()) };
        *position = position.with_vector(end);
    }
    for (turn, spin) in turn.iter_mut().zip(spin) {
        *turn = turn.with_vector(turn.vector() + spin.vector());
    }
    if solver.has_moving_surfaces {
        let end = sub_step.time + sub_step.h;
        surfaces::places_after(system.surfaces, end, &mut solver.places);
    }
}
