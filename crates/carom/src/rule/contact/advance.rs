//! Positions follow the velocities.

use glam::DVec3;

use super::slots::Run;
use super::solver::Solver;
use super::sub_step::SubStep;
use super::surfaces;
use crate::system::System;

/// Moves spheres and surfaces over the sub-step.
///
/// A sphere that bears something moves by its last velocity. One that nothing touches flies on a parabola,
/// and one that bounces on two, which meet at the impact.
///
/// No sphere leaves the margin within which its neighbours are known: one that an impact has made so fast
/// is late by the rest of its way.
pub(super) fn advance(system: &System, solver: &mut Solver, sub_step: &SubStep) {
    let Solver { slots, slabs, bounces, .. } = solver;
    let h = sub_step.h;
    let flies = !solver.has_other_forces;
    slabs.each(slots, |mut run, slab| {
        let from = bounces.partition_point(|bounce| (bounce.slot as usize) < slab.start);
        let to = bounces.partition_point(|bounce| (bounce.slot as usize) < slab.end);
        advance_run(&mut run, h, flies);
        for bounce in &bounces[from..to] {
            let slot = bounce.slot as usize - slab.start;
            let position = &mut run.position[slot];
            *position = position.with_vector(position.vector() + bounce.shift);
            run.bears[slot] = false;
        }
        stay_within_margin(&mut run);
        for (turn, spin) in run.turn.iter_mut().zip(&*run.spin) {
            *turn = turn.with_vector(turn.vector() + spin.vector());
        }
    });
    if solver.has_moving_surfaces {
        let end = sub_step.time + h;
        surfaces::places_after(system.surfaces, end, &mut solver.places);
    }
}

fn advance_run(run: &mut Run, h: f64, flies: bool) {
    for slot in 0..run.position.len() {
        let (before, velocity) = (run.before[slot], run.velocity[slot]);
        let flies = flies && velocity == run.accelerated(slot, h);
        run.bears[slot] = !flies;
        let mean =
            if flies { 0.5 * (before.vector() + velocity.vector()) } else { velocity.vector() };
        let position = &mut run.position[slot];
        *position = position.with_vector(position.vector() + h * mean);
    }
}

fn stay_within_margin(run: &mut Run) {
    for (position, reference) in run.position.iter_mut().zip(run.reference) {
        let (origin, margin) = (reference.vector(), reference.number());
        let way = position.vector() - origin;
        let length_squared = way.length_squared();
        if length_squared > margin * margin {
            let end: DVec3 = origin + way * (margin / length_squared.sqrt());
            *position = position.with_vector(end);
        }
    }
}
