//! Keep energy: no impulse adds kinetic energy beside the work of surfaces, neither by restitution in a group of
//! contacts nor by a starting impulse that is no longer needed.

use fearless_simd::{Level, dispatch};
use glam::DVec3;

use super::accelerate::{kinetic_energy, work_of_impulses};
use super::contacts::surfaces::SurfaceContact;
use super::slabs::Slab;
use super::slots::Run;
use super::slots::row::Row;
use super::solve;
use super::solver::Solver;
use super::sub_step::SubStep;
use crate::report::StepReport;

/// Gains up to this part of the kinetic energy are rounding.
const ROUNDING: f64 = 1e-14;

/// Gains up to this part of the kinetic energy are left where surfaces move: few sweeps add and take as much, and less
/// restitution for their sake would calm what is shaken.
const SHAKEN: f64 = 1e-3;

/// Largest number of rounds of further sweeps where impulses added kinetic energy; from [`SOFTENING`] on with less
/// restitution.
const ROUNDS: u32 = 12;
const SOFTENING: u32 = 3;

/// Limits impulses so that they add no kinetic energy, and accounts for their work. Returns whether it changed
/// them.
///
/// Impulses to start from may be too large, and a few sweeps do not take all of that back; more sweeps do.
/// Restitution in a group of contacts may add energy whatever the sweeps: there, less is given back. As a
/// last resort less of all impulses is taken.
///
/// Kicks, belts and moving surfaces do work, which counts as no gain; nor does what forces add because a bounce turns
/// a sphere round within the sub-step.
pub(super) fn keep(solver: &mut Solver, sub_step: &SubStep, report: &mut StepReport) -> bool {
    let before = solver.energy_before;
    let h = sub_step.h;
    let mut change = change(solver, h);
    let kicks = kick_work(solver);
    let mut round = 0;
    let tolerance = if solver.has_moving_surfaces { SHAKEN } else { ROUNDING };
    let gains = |solver: &mut Solver, change: &Change| {
        let driven = driven_work(solver, h);
        let beyond = change.gain - kicks - driven;
        let least = tolerance * (before + driven.abs());
        beyond > least && beyond - gain_by_turning(solver, h) > least
    };
    while gains(solver, &change) && round < ROUNDS {
        if round >= SOFTENING {
            solve::soften_bounces(solver, 0.5);
        }
        solve::sweep_once(solver, true, report);
        solve::sweep_once(solver, false, report);
        change = self::change(solver, h);
        round += 1;
    }
    report.contact_account.limited_sub_steps += u32::from(round > 0);
    let mut part = 1.0;
    if gains(solver, &change) {
        let gain = change.gain - driven_work(solver, h) - gain_by_turning(solver, h);
        part = take_less(solver, gain, h);
        change = self::change(solver, h);
    }
    let kicks = kick_work(solver);
    report.energy_account.kicks += kicks;
    report.energy_account.contacts += change.work - kicks;
    // Impulses act on images with the velocities of these.
    report.energy_account.contacts += part * image_work(solver);
    if is_driven(solver) {
        let work = part * surface_work(solver);
        report.energy_account.colliders += work;
        report.energy_account.contacts -= work;
    }
    round > 0
}

/// Whether surfaces move, or friction acts and some are belts.
fn is_driven(solver: &Solver) -> bool {
    solver.has_moving_surfaces || solver.has_belts
}

/// Work of surfaces that move and of belts in a sub-step \[J\].
fn surface_work(solver: &Solver) -> f64 {
    let surfaces = solver.slabs.iter().flat_map(|slab| &slab.surfaces);
    surfaces.map(|contact| contact.work()).sum()
}

/// Work \[J\] of the impulses of a sub-step on sliding images beyond that on the spheres; 0 without shear.
fn image_work(solver: &Solver) -> f64 {
    if !solver.kinds.shear {
        return 0.0;
    }
    let of_slab = |slab: &Slab| {
        let of_pair = |(number, lane, _)| {
            slab.batches.slide(number, lane) * slab.batches.impulse(number, lane).x
        };
        slab.batches.contacts().map(of_pair).sum::<f64>()
    };
    solver.slabs.iter().map(of_slab).sum()
}

/// The most energy \[J\] that belts, moving surfaces and sliding images may add in a sub-step of `h` \[s\].
fn driven_work(solver: &mut Solver, h: f64) -> f64 {
    let of_images = -image_work(solver);
    if !is_driven(solver) {
        return of_images;
    }
    solver.slabs.each(&mut solver.slots, |run, slab| {
        let beside =
            |it: &SurfaceContact| most_beside_work(it, run.accelerated(it.slot as usize, h));
        slab.totals.energy = slab.surfaces.iter().map(beside).sum();
    });
    surface_work(solver) + solver.slabs.energy() + of_images
}

/// The most energy \[J\] that a moving surface may add beside its work, for the velocity of the sphere before impulses
/// \[m/s\]: a sphere may have to leave the surface, which turns, or pulls away from a bounce.
fn most_beside_work(contact: &SurfaceContact, before: DVec3) -> f64 {
    if contact.velocity == DVec3::ZERO && contact.angular_velocity == DVec3::ZERO {
        return 0.0;
    }
    // An impulse along the normal adds its product with the mean of the speeds before and after it; beside other
    // impulses, at most that with the speed after them.
    let leaving = if contact.is_bounce() {
        0.5 * ((before - contact.velocity).dot(contact.normal) - contact.bias)
    } else {
        -contact.bias
    };
    contact.impulses.normal * leaving.max(0.0)
}

/// What the forces of a sub-step of `h` \[s\] add to the kinetic energy because bounces turn spheres round within it
/// \[J\].
///
/// The gain of impulses is counted as though they came after all forces. A ball that rises to a ceiling is slower then
/// than when it bounces, and gravity makes it faster afterwards: with the speed of approach s that forces leave it, and
/// the speed w with which its bounce has it leave at the end, that is m (w² − s²)/2.
fn gain_by_turning(solver: &Solver, h: f64) -> f64 {
    let Solver { slots, slabs, .. } = solver;
    let of_surface = |slab: &Slab, it: &SurfaceContact| {
        let slot = slab.start + it.slot as usize;
        let approach = (it.velocity - slots.accelerated(slot, h)).dot(it.normal);
        let mass = slots.velocity[slot].number().recip();
        let is_there = it.is_bounce() && it.impulses.normal > 0.0;
        if is_there { energy_beyond(mass, -it.bias - it.kicked, approach) } else { 0.0 }
    };
    let of_pair = |slab: &Slab, (number, lane, _): (usize, usize, f64)| {
        let batch = &slab.batches.pairs[number];
        let [first, second] = slab.slots_of(number, lane).map(|slot| slots.accelerated(slot, h));
        let slide = DVec3::new(slab.batches.slide(number, lane), 0.0, 0.0);
        let approach = (first - second - slide).dot(slab.batches.normal(number, lane));
        energy_beyond(batch.effective_mass[lane], -batch.bias[lane], approach)
    };
    let of_slab = |slab: &Slab| {
        let surfaces = slab.surfaces.iter().map(|it| of_surface(slab, it));
        let pairs = slab.batches.impacts().map(|it| of_pair(slab, it));
        surfaces.sum::<f64>() + pairs.sum::<f64>()
    };
    slabs.iter().map(of_slab).sum()
}

/// The kinetic energy \[J\] of a mass \[kg\] at a speed, beyond that at another one \[m/s\]; 0 if it is less.
fn energy_beyond(mass: f64, speed: f64, other: f64) -> f64 {
    let speed = speed.max(0.0);
    (0.5 * mass * (speed - other) * (speed + other)).max(0.0)
}

/// Work of the kicks of surfaces in a sub-step \[J\].
fn kick_work(solver: &Solver) -> f64 {
    let of_slab = |slab: &Slab| {
        let mass = |slot: u32| solver.slots.velocity[slab.start + slot as usize].number().recip();
        slab.surfaces.iter().map(|it| it.kick_work(mass(it.slot))).sum::<f64>()
    };
    solver.slabs.iter().map(of_slab).sum()
}

/// The effect of impulses on the kinetic energy of a sub-step.
struct Change {
    /// Change of kinetic energy \[J\], with the impulses applied after the forces of the sub-step.
    gain: f64,
    /// Work of the impulses \[J\] as of forces that act over the whole sub-step: with the mean of the velocities at
    /// its two ends. It is zero for a sphere at rest.
    work: f64,
}

/// The effect of the impulses of a sub-step of `h` \[s\] on the kinetic energy.
fn change(solver: &mut Solver, h: f64) -> Change {
    solver.slabs.each(&mut solver.slots, |run, slab| {
        let (energy, work) = dispatch!(Level::new(), simd => {
            let work = work_of_impulses(simd, &run, h);
            (kinetic_energy(simd, run.velocity) + kinetic_energy(simd, run.spin), work)
        });
        (slab.totals.energy, slab.totals.work) = (energy, work);
    });
    let work = solver.slabs.iter().map(|slab| slab.totals.work).sum();
    Change { gain: solver.slabs.energy() - solver.energy_before, work }
}

/// Reduces all impulses so that they add nothing, in a sub-step of `h` \[s\]. Returns the part of them that is left.
///
/// With the velocities v before them and v + d after, the kinetic energy of `v + s d` is a parabola in s
/// that begins with a descent; s is the largest part that adds nothing. Momentum is kept for any s.
fn take_less(solver: &mut Solver, gain: f64, h: f64) -> f64 {
    solver.slabs.each(&mut solver.slots, |run, slab| slab.totals.energy = of_change(&run, h));
    // K(s) = K(0) + s slope + s² change, with the energy of the change alone.
    let change = solver.slabs.energy();
    let slope = gain - change;
    let part = if change > 0.0 { (-slope / change).clamp(0.0, 1.0) } else { 0.0 };
    solver.slabs.each_run(&mut solver.slots, |mut run| take(&mut run, h, part));
    part
}

/// Kinetic energy of the velocity changes by impulses \[J\].
fn of_change(run: &Run, h: f64) -> f64 {
    // Sleeping spheres do not change and have no mass here.
    let of = |now: Row, before: DVec3| {
        let change = (now.vector() - before).length_squared();
        if change > 0.0 { change / now.number() } else { 0.0 }
    };
    let velocities =
        (0..run.velocity.len()).map(|slot| of(run.velocity[slot], run.accelerated(slot, h)));
    let spins =
        run.spin.iter().zip(&*run.spin_before).map(|(now, before)| of(*now, before.vector()));
    0.5 * (velocities.sum::<f64>() + spins.sum::<f64>())
}

/// Scales the velocity changes by impulses.
fn take(run: &mut Run, h: f64, part: f64) {
    let between =
        |before: DVec3, now: Row| now.with_vector(before + part * (now.vector() - before));
    for slot in 0..run.velocity.len() {
        run.velocity[slot] = between(run.accelerated(slot, h), run.velocity[slot]);
    }
    for (now, before) in run.spin.iter_mut().zip(&*run.spin_before) {
        *now = between(before.vector(), *now);
    }
}
