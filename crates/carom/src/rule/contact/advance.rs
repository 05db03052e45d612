//! Advance: moves positions by the velocities.

use fearless_simd::{Level, Simd, SimdMask, dispatch};
use glam::DVec3;

use super::accelerate;
use super::slabs::landings::Landed;
use super::slots::Run;
use super::slots::drift::Drift;
use super::slots::row::{self, BOUNDLESS};
use super::solver::{Bounce, Solver};
use super::sub_step::SubStep;
use crate::lanes::{LANES, Lanes};
use crate::real::Vector;
use crate::report::StepReport;

/// An impact has made a sphere faster whose squared speed has grown by more than this factor: far more than
/// rounding, and less than margins allow for.
const FASTER: f64 = 1.01;

/// Moves spheres over the sub-step.
///
/// A sphere that bears something moves by its last velocity. One that nothing touches flies on a parabola,
/// and one that bounces on two, which meet at the impact.
///
/// No sphere leaves the margin within which its neighbours are known: one that an impact has made so fast
/// is late by the rest of its way. One that impacts have only turned round is not taken along by the motion
/// that all have in common: that would take it through walls.
///
/// Forces do work along the path, impulses with the mean of the velocities at both ends of the sub-step. The
/// difference is work of the contacts that changed the path.
pub(super) fn advance(solver: &mut Solver, sub_step: &SubStep, report: &mut StepReport) {
    solver.drift = solver.drift.after(sub_step.h);
    let Solver { slots, slabs, bounces, landings, drift, .. } = solver;
    let drift = *drift;
    slabs.each(slots, |mut run, slab| {
        let from = bounces.partition_point(|bounce| (bounce.slot as usize) < slab.start);
        let to = bounces.partition_point(|bounce| (bounce.slot as usize) < slab.end);
        let run = &mut run;
        let touched = dispatch!(Level::new(), simd => advance_run(simd, run, sub_step.h));
        let bounces = &bounces[from..to];
        let bounced = shift_bounced(run, slab.start, bounces);
        let landed = &landings.spheres;
        let from = landed.partition_point(|it| (it.slot as usize) < slab.start);
        let to = landed.partition_point(|it| (it.slot as usize) < slab.end);
        let landed = &landed[from..to];
        slab.totals.energy = touched + bounced + place_landed(run, slab.start, landed, sub_step.h);
        let is_free = |slot: usize| {
            let slot = (slab.start + slot) as u32;
            let found = bounces.binary_search_by_key(&slot, |bounce| bounce.slot);
            found.is_ok_and(|place| bounces[place].is_at_surface)
                || landed
                    .binary_search_by_key(&slot, |it| it.slot)
                    .is_ok_and(|place| landed[place].met_surface)
        };
        let (leaves, held_back) =
            dispatch!(Level::new(), simd => stay_within_margin(simd, run, drift, is_free));
        slab.totals.leaves = leaves;
        slab.totals.energy += held_back;
        for (turn, spin) in run.turn.iter_mut().zip(&*run.spin) {
            *turn = turn.with_vector(turn.vector() + spin.vector());
        }
    });
    report.energy_account.contacts += slabs.energy();
    if slots.shear.is_some() {
        slabs.iter_mut().for_each(|slab| slab.batches.slide_images(sub_step.h));
    }
}

/// Advances the spheres of a run. Returns the work of contacts by the paths of spheres that they touch \[J\].
#[inline(always)]
fn advance_run<S: Simd>(simd: S, run: &mut Run, h: f64) -> f64 {
    let zero = Lanes::all(simd, 0.0);
    let mut work = zero;
    for slot in (0..run.position.len()).step_by(LANES) {
        let (before, _) = row::columns(simd, run.before, slot);
        let (velocity, inverse_mass) = row::columns(simd, run.velocity, slot);
        let acceleration = row::columns(simd, run.acceleration, slot);
        let flown = accelerate::accelerated(simd, before, acceleration, h);
        let is_free = velocity.x.is_equal(flown.x)
            & velocity.y.is_equal(flown.y)
            & velocity.z.is_equal(flown.z);
        let bears = Lanes::all(simd, 0.0).select(is_free, Lanes::all(simd, 1.0));
        for (bears, number) in run.bears[slot..].iter_mut().zip(bears.to_array()) {
            *bears = number > 0.0;
        }
        let mean = (before + velocity) * Lanes::all(simd, 0.5);
        let mean = mean.select(is_free, velocity);
        let (position, radius) = row::columns(simd, run.position, slot);
        row::store(run.position, slot, (position + mean * Lanes::all(simd, h), radius));
        let own = acceleration.0.dot(velocity - before) / inverse_mass;
        let own = zero.select(is_free, own);
        work = work + own.select(zero.is_less(inverse_mass), zero);
    }
    -0.5 * h * work.sum()
}

/// Moves bouncing spheres to the ends of their paths. Returns the work of their contacts on the way \[J\].
fn shift_bounced(run: &mut Run, start: usize, bounces: &[Bounce]) -> f64 {
    let mut work = 0.0;
    for bounce in bounces {
        let slot = bounce.slot as usize - start;
        work += work_of_shift(run, slot, bounce.shift);
        let (before, inverse_mass) = (run.velocity[slot].vector(), run.velocity[slot].number());
        if inverse_mass > 0.0 && before != bounce.velocity {
            let change = (bounce.velocity - before).dot(bounce.velocity + before);
            work += 0.5 * change / inverse_mass;
        }
        let position = &mut run.position[slot];
        *position = position.with_vector(position.vector() + bounce.shift);
        run.velocity[slot] = run.velocity[slot].with_vector(bounce.velocity);
        run.bears[slot] &= !bounce.is_alone;
    }
    work
}

/// Work of the contacts of a sphere \[J\] that shift it against forces \[m\].
fn work_of_shift(run: &Run, slot: usize, shift: DVec3) -> f64 {
    let inverse_mass = run.velocity[slot].number();
    if inverse_mass > 0.0 {
        -run.acceleration[slot].vector().dot(shift) / inverse_mass
    } else {
        0.0
    }
}

/// Moves spheres of cascades to the ends of their paths. Returns the work of their contacts by that \[J\].
fn place_landed(run: &mut Run, start: usize, landed: &[Landed], h: f64) -> f64 {
    let mut work = 0.0;
    for it in landed {
        let slot = it.slot as usize - start;
        // The run counted a path with the last velocity.
        let [before, last] = [run.before[slot], run.velocity[slot]].map(|row| row.vector());
        let counted = if last == run.accelerated(slot, h) { 0.0 } else { 0.5 * h };
        work += work_of_shift(run, slot, it.path - it.way - counted * (last - before));
        run.position[slot] = run.position[slot].with_vector(it.position);
        run.bears[slot] = it.bears;
    }
    work
}

/// Keeps spheres that an impact made faster within their margins relative to the common motion; spheres that
/// are `free`, by slot, are exempt. Returns whether one has left its margin, and the work of holding others back \[J\].
#[inline(always)]
fn stay_within_margin<S: Simd>(
    simd: S,
    run: &mut Run,
    drift: Drift,
    is_free: impl Fn(usize) -> bool,
) -> (bool, f64) {
    let (mut leaves, mut work) = (false, 0.0);
    let commons = Vector::all(simd, drift.way);
    for first in (0..run.position.len()).step_by(LANES) {
        let (position, radius) = row::columns(simd, run.position, first);
        let (reference, margin) = row::columns_or(simd, run.reference, first, BOUNDLESS);
        let (mut way, mut reach) = (position - reference - commons, margin * margin);
        if drift.strain != 0.0 {
            way.x = way.x - reference.y * drift.strain;
            reach = drift.reach_after(simd, radius, margin);
        }
        if !reach.is_less(way.length_squared()).any_true() {
            continue;
        }
        let last = run.position.len().min(first + LANES);
        for slot in first..last {
            let (position, reference) = (run.position[slot], &run.reference[slot]);
            let origin = reference.vector() + drift.way_from(reference.vector());
            let margin = drift.margin_after(position.number(), reference.number()).max(0.0);
            let way = position.vector() - origin;
            let length_squared = way.length_squared();
            let flow = DVec3::new(drift.rate * position.vector().y, 0.0, 0.0);
            let [before, now] =
                [run.before[slot], run.velocity[slot]].map(|row| row.vector() - flow);
            let is_faster = now.length_squared() > FASTER * before.length_squared();
            let is_beyond = length_squared > margin * margin;
            let is_late = is_beyond && is_faster && !is_free(slot);
            leaves |= is_beyond && !is_late;
            if is_late {
                let end: DVec3 = origin + way * (margin / length_squared.sqrt());
                // Other forces have done their work on the way as far as it went.
                work += run.work_of_move(slot, end - position.vector());
                run.position[slot] = position.with_vector(end);
            }
        }
    }
    (leaves, work)
}
