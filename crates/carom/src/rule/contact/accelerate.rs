//! Accelerate: applies forces to velocities.

use fearless_simd::{Level, Simd, SimdMask, dispatch};

use super::slabs::Slabs;
use super::slots::drift::Drift;
use super::slots::row::{self, BOUNDLESS, Row};
use super::slots::slab_totals::SlabTotals;
use super::slots::{Run, Slots};
use super::solver::Solver;
use super::sub_step::SubStep;
use crate::lanes::{LANES, Lanes};
use crate::real::{Real, Vector};
use crate::system::System;

/// Marks a sphere that presses on something, in the number beside its velocity at the start of a sub-step: its
/// difference from any other sphere's number is not zero.
const BEARS: f64 = f64::INFINITY;

/// Changes velocities by all forces over a sub-step of `h` \[s\], one of those of a frame that starts at a time
/// \[s\]: `v' = (v + h a) / (1 + h c)` with the rate c of linear drag, which never reverses a velocity.
pub(super) fn accelerate(
    system: &System,
    frame_start: f64,
    h: f64,
    number: u32,
    solver: &mut Solver,
) -> SubStep {
    let time = f64::from(number) * h;
    solver.h = h;
    if solver.has_other_forces {
        solver.slots.add_other_forces(system, frame_start + time, h);
    }
    let drift = solver.drift;
    solver.slabs.each(&mut solver.slots, |mut run, slab| {
        slab.totals = dispatch!(Level::new(), simd => accelerate_run(simd, &mut run, h, drift));
    });
    solver.energy_before = solver.slabs.energy();
    solver.is_stale |= drift.after(h).is_beyond();
    solver.is_stale |= solver.slabs.list.iter().any(|slab| slab.totals.leaves);
    let change = solver.slabs.list.iter().map(|slab| slab.totals.change).fold(0.0, f64::max);
    match solver.slots.shear {
        // Neighbours in the flow turn about each other.
        Some(shear) => {
            let turning = shear.rate * shear.rate * 2.0 * solver.smallest_radius;
            SubStep::new(time, h, None, h * turning)
        }
        None => SubStep::new(time, h, solver.common_acceleration, change),
    }
}

/// Accelerates the spheres of a run; sleeping ones stay at rest. Returns their kinetic energy, the largest change
/// of a velocity, and whether one may leave its margin in the sub-step.
#[inline(always)]
fn accelerate_run<S: Simd>(simd: S, run: &mut Run, h: f64, drift: Drift) -> SlabTotals {
    run.spin_before.copy_from_slice(run.spin);
    let zero = Lanes::all(simd, 0.0);
    let length = Lanes::all(simd, h);
    // Distances relative to the common motion, at the end of the sub-step.
    let drift = drift.after(h);
    let common = Vector::all(simd, drift.way);
    let [mut energy, mut change] = [zero; 2];
    let mut leaves = false;
    for slot in (0..run.velocity.len()).step_by(LANES) {
        let (before, inverse_mass) = row::columns(simd, run.velocity, slot);
        let (acceleration, drag_rate) = row::columns(simd, run.acceleration, slot);
        let mut now = accelerated(simd, before, (acceleration, drag_rate), h);
        let sleeps = row::flags(simd, run.sleeps, slot, |sleeps| sleeps);
        if sleeps.any_true() {
            now = before.select(sleeps, now);
        }
        row::store(run.velocity, slot, (now, inverse_mass));
        let bears = row::flags(simd, run.bears, slot, |bears| bears);
        let bears = Lanes::all(simd, BEARS).select(bears, zero);
        row::store(run.before, slot, (before, bears));

        energy = energy + twice_energy(simd, now, inverse_mass);
        change = change.max((now - before).length_squared());
        // A flight ends between the places that its first and its last velocity lead to.
        let (position, radius) = row::columns(simd, run.position, slot);
        let (reference, margin) = row::columns_or(simd, run.reference, slot, BOUNDLESS);
        let (mut way, mut reach) = (position - reference - common, margin * margin);
        if drift.strain != 0.0 {
            way.x = way.x - reference.y * drift.strain;
            reach = drift.reach_after(simd, radius, margin);
        }
        let first = (way + before * length).length_squared();
        let last = (way + now * length).length_squared();
        leaves |= (reach.is_less(first) | reach.is_less(last)).any_true();
    }
    let of_spin = kinetic_energy(simd, run.spin);
    SlabTotals {
        energy: 0.5 * energy.sum() + of_spin,
        change: change.largest().sqrt(),
        leaves,
        ..SlabTotals::default()
    }
}

/// Velocities at the end of a sub-step of `h` \[s\], without contacts \[m/s\].
#[inline(always)]
pub(super) fn accelerated<S: Simd>(
    simd: S,
    before: Vector<Lanes<S>>,
    (acceleration, drag_rate): (Vector<Lanes<S>>, Lanes<S>),
    h: f64,
) -> Vector<Lanes<S>> {
    let gained = before + acceleration * Lanes::all(simd, h);
    let drag = drag_rate * h;
    if drag.is_equal(Lanes::all(simd, 0.0)).all_true() {
        return gained;
    }
    let slowed = Lanes::all(simd, 1.0) + drag;
    Vector { x: gained.x / slowed, y: gained.y / slowed, z: gained.z / slowed }
}

/// Kinetic energy of all spheres \[J\].
pub(super) fn kinetic_energy_of(slots: &mut Slots, slabs: &mut Slabs) -> f64 {
    slabs.each(slots, |run, slab| {
        slab.totals.energy = dispatch!(Level::new(), simd => {
            kinetic_energy(simd, run.velocity) + kinetic_energy(simd, run.spin)
        });
    });
    slabs.energy()
}

/// Kinetic energy \[J\] of rows of velocities beside 1/m, or of spins beside 1/(k m).
#[inline(always)]
pub(super) fn kinetic_energy<S: Simd>(simd: S, rows: &[Row]) -> f64 {
    let mut energy = Lanes::all(simd, 0.0);
    for slot in (0..rows.len()).step_by(LANES) {
        let (velocity, inverse_mass) = row::columns(simd, rows, slot);
        energy = energy + twice_energy(simd, velocity, inverse_mass);
    }
    0.5 * energy.sum()
}

/// Twice the kinetic energy \[J\]; 0 for immovable rows.
#[inline(always)]
fn twice_energy<S: Simd>(simd: S, velocity: Vector<Lanes<S>>, inverse_mass: Lanes<S>) -> Lanes<S> {
    let zero = Lanes::all(simd, 0.0);
    let energy = velocity.length_squared() / inverse_mass;
    energy.select(zero.is_less(inverse_mass), zero)
}

/// Work \[J\] of the impulses of a sub-step of `h` \[s\] on the spheres of a run, with the mean of their
/// velocities before forces and after impulses; the spin changes by impulses alone.
#[inline(always)]
pub(super) fn work_of_impulses<S: Simd>(simd: S, run: &Run, h: f64) -> f64 {
    let zero = Lanes::all(simd, 0.0);
    let mut twice = zero;
    let mut add = |change: Vector<Lanes<S>>, sum: Vector<Lanes<S>>, inverse_mass: Lanes<S>| {
        let work = change.dot(sum) / inverse_mass;
        // Sleeping spheres are immovable.
        twice = twice + work.select(zero.is_less(inverse_mass), zero);
    };
    for slot in (0..run.velocity.len()).step_by(LANES) {
        let (now, inverse_mass) = row::columns(simd, run.velocity, slot);
        let (before, _) = row::columns(simd, run.before, slot);
        let force = row::columns(simd, run.acceleration, slot);
        add(now - accelerated(simd, before, force, h), now + before, inverse_mass);
    }
    for slot in (0..run.spin.len()).step_by(LANES) {
        let (now, inverse_mass) = row::columns(simd, run.spin, slot);
        let (before, _) = row::columns(simd, run.spin_before, slot);
        add(now - before, now + before, inverse_mass);
    }
    0.5 * twice.sum()
}
