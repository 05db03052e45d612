//! Sweep and Correct for pairs of spheres: one batch at a time, one contact per lane of the processor's vectors.

use fearless_simd::{Level, Simd, dispatch};

use super::batch::{Batches, FrictionBatch, PairBatch, Quad, RollingBatch};
use super::gather::{
    TINY, apply, apply_spin, arrays, gathered, is_any, limited, offset, relative_velocity, rows_of,
    shift, slip, smaller, sum, turn, vector, xyz,
};
use crate::lanes::Lanes;
use crate::real::Real;
use crate::rule::contact::slots::Run;
use crate::rule::contact::slots::row::Row;
use crate::rule::contact::slots::slab_totals::SlabTotals;
use crate::rule::contact::sub_step::{RELAXATION, SLOP};

/// Sweeps over the contacts of a run, forwards or backwards: each gets the impulse that it needs with the others as
/// they are. Returns the largest change of an impulse and the largest impulse.
pub(crate) fn sweep(run: &mut Run, batches: &mut Batches, backwards: bool) -> SlabTotals {
    let level = Level::new();
    macro_rules! sweep {
        ($friction:literal, $rolling:literal) => {
            dispatch!(level, simd => sweep_all::<_, $friction, $rolling>(
                simd, run, batches, backwards
            ))
        };
    }
    match (!batches.frictions.is_empty(), !batches.rollings.is_empty()) {
        (false, _) => sweep!(false, false),
        (true, false) => sweep!(true, false),
        (true, true) => sweep!(true, true),
    }
}

/// Moves spheres that overlap apart; velocities stay as they are. Returns the work against the conservative forces
/// \[J\], and the largest overlap as a part of the sum of radii.
pub(crate) fn correct(run: &mut Run, batches: &Batches) -> SlabTotals {
    dispatch!(Level::new(), simd => correct_all(simd, run, batches))
}

#[inline(always)]
fn sweep_all<S: Simd, const FRICTION: bool, const ROLLING: bool>(
    simd: S,
    run: &mut Run,
    batches: &mut Batches,
    backwards: bool,
) -> SlabTotals {
    let Batches { pairs, frictions, rollings, slides, .. } = batches;
    let [mut largest_change, mut largest_impulse, mut least_room] = [Lanes::all(simd, 0.0); 3];
    let count = pairs.len();
    for step in 0..count {
        let number = if backwards { count - 1 - step } else { step };
        let batch = &mut pairs[number];
        let before = Lanes::each(simd, batch.impulse);
        let moving = Moving { batch, slide: slides.get(number) };
        let Solved { change, room } = if FRICTION {
            let rolling = if ROLLING { rollings.get_mut(number) } else { None };
            solve_with_friction(simd, run, moving, &mut frictions[number], rolling)
        } else {
            solve(simd, run, moving)
        };
        let batch = &pairs[number];
        largest_change = largest_change.max(change.abs());
        largest_impulse = largest_impulse.max(before);
        largest_impulse = largest_impulse.max(Lanes::each(simd, batch.impulse));
        least_room = smaller(least_room, room);
    }
    let excess = (Lanes::all(simd, 0.0) - least_room).largest();
    let [change, impulse] = [largest_change, largest_impulse].map(Lanes::largest);
    SlabTotals { change, excess, impulse, ..SlabTotals::default() }
}

/// The pairs of a batch, and the velocities of images relative to spheres 2, along x \[m/s\].
struct Moving<'a> {
    batch: &'a mut PairBatch,
    slide: Option<&'a Quad>,
}

/// Result of solving a batch.
struct Solved<S: Simd> {
    /// Changes of the normal impulses \[N s\].
    change: Lanes<S>,
    /// Distance of normal velocities from their bounds \[m/s\]; negative below.
    room: Lanes<S>,
}

/// Returns the normal impulses of a batch after a sweep \[N s\], from normal speeds \[m/s\].
#[inline(always)]
fn solve_along_normal<S: Simd>(
    simd: S,
    batch: &PairBatch,
    speed: Lanes<S>,
) -> (Lanes<S>, Solved<S>) {
    let impulse = Lanes::each(simd, batch.impulse);
    let room = speed + Lanes::each(simd, batch.bias);
    let zero = Lanes::all(simd, 0.0);
    let solved = (impulse - Lanes::each(simd, batch.effective_mass) * room).max(zero);
    (solved, Solved { change: solved - impulse, room })
}

/// Solves the contacts of a batch without friction: one normal impulse each.
#[inline(always)]
fn solve<S: Simd>(simd: S, run: &mut Run, Moving { batch, slide }: Moving) -> Solved<S> {
    let normal = vector(simd, &batch.normal);
    let speed = xyz(relative_velocity(simd, run.velocity, batch, slide)).dot(normal);
    let (solved, Solved { change, room }) = solve_along_normal(simd, batch, speed);
    if is_any(simd, change) {
        batch.impulse = solved.to_array();
        apply(simd, run.velocity, batch, normal * change);
    }
    Solved { change, room }
}

/// Solves the contacts of a batch: a normal impulse each, then a tangential one within Coulomb's disc.
///
/// An impulse along the normal changes no slip, and one across it no normal speed: so both follow in
/// closed form.
#[inline(always)]
fn solve_with_friction<S: Simd>(
    simd: S,
    run: &mut Run,
    Moving { batch, slide }: Moving,
    friction: &mut FrictionBatch,
    rolling: Option<&mut RollingBatch>,
) -> Solved<S> {
    let normal = vector(simd, &batch.normal);
    let velocity = xyz(relative_velocity(simd, run.velocity, batch, slide));
    let before = Lanes::each(simd, batch.impulse);
    let (solved, Solved { change, room }) = solve_along_normal(simd, batch, velocity.dot(normal));
    if !is_any(simd, solved.max(before)) {
        return Solved { change, room };
    }
    batch.impulse = solved.to_array();

    let slip = slip(velocity, normal, xyz(sum(simd, run.spin, batch)));
    let tangential = vector(simd, &friction.tangential);
    let excess = slip - vector(simd, &friction.slip);
    let wanted = tangential - excess * Lanes::each(simd, friction.tangential_mass);
    let most = Lanes::each(simd, friction.sliding) * solved;
    let limited = limited(simd, wanted, most);
    friction.tangential = arrays(limited);
    let across = limited - tangential;
    apply(simd, run.velocity, batch, normal * change + across);
    apply_spin(simd, run.spin, batch, normal.cross(across));
    if let Some(rolling) = rolling {
        solve_rolling(simd, run, batch, rolling);
    }
    Solved { change, room }
}

/// Applies angular impulses against rolling and spinning at each contact of a batch.
#[inline(always)]
fn solve_rolling<S: Simd>(simd: S, run: &mut Run, batch: &PairBatch, rolling: &mut RollingBatch) {
    let normal = vector(simd, &batch.normal);
    let first = xyz(Lanes::transposed(gathered(simd, run.spin, &batch.first)));
    let second = xyz(Lanes::transposed(gathered(simd, run.spin, &batch.second)));
    let [curvature_1, curvature_2] = rolling.curvature;
    let relative = second * Lanes::each(simd, curvature_2) - first * Lanes::each(simd, curvature_1);
    let angular = vector(simd, &rolling.angular);
    let wanted = angular - relative * Lanes::each(simd, rolling.inertia);
    let spinning = wanted.dot(normal);
    let impulse = Lanes::each(simd, batch.impulse);
    let rolls = wanted - normal * spinning;
    let rolls = limited(simd, rolls, Lanes::each(simd, rolling.rolling) * impulse);
    let most = Lanes::each(simd, rolling.spinning) * impulse;
    let spins = limited(simd, normal * spinning, most);
    let solved = rolls + spins;
    rolling.angular = arrays(solved);
    turn(simd, run.spin, batch, rolling, solved - angular);
}

#[inline(always)]
fn correct_all<S: Simd>(simd: S, run: &mut Run, batches: &Batches) -> SlabTotals {
    let zero = Lanes::all(simd, 0.0);
    let (mut largest, mut work) = (zero, 0.0);
    let both = batches.pairs.iter().zip(&batches.approaches);
    for (number, (batch, approach)) in both.enumerate() {
        let offset = offset(simd, run.position, batch, batches.shifts.get(number));
        let length = offset.length_squared().sqrt();
        let radius_sum = Lanes::each(simd, approach.radius_sum);
        let overlap = radius_sum * (1.0 - SLOP) - length;
        // Coincident centres are separated by the velocities alone.
        let is_whole = Lanes::all(simd, TINY).is_less(length);
        let overlap = overlap.max(zero).select(is_whole, zero);
        if !is_any(simd, overlap) {
            continue;
        }
        // An overlap within the slop counts as none.
        largest = largest.max(overlap / radius_sum.max(Lanes::all(simd, TINY)));
        let effective_mass = Lanes::each(simd, batch.effective_mass);
        let push = overlap * effective_mass * RELAXATION / length.max(Lanes::all(simd, TINY));
        let rows = rows_of(simd, offset * push);
        for (lane, row) in rows.into_iter().enumerate() {
            let (first, second) = (batch.first[lane] as usize, batch.second[lane] as usize);
            let of_first = -run.velocity[first].number();
            shift(simd, &mut run.position[first], row * of_first);
            let of_second = run.velocity[second].number();
            shift(simd, &mut run.position[second], row * of_second);
            // Forces do no work on what sleeps, which stays where it is.
            let push = Row(row.to_array()).vector();
            let along = |slot: usize| run.conservative_acceleration(slot).dot(push);
            work += if of_first < 0.0 { along(first) } else { 0.0 };
            work -= if of_second > 0.0 { along(second) } else { 0.0 };
        }
    }
    SlabTotals { energy: work, overlap: largest.largest(), ..SlabTotals::default() }
}
