//! Work of nonconservative forces in a sub-step.

use glam::DVec3;

use crate::force_work::ForceWork;
use crate::forces::{self, SphereState};
use crate::report::StepReport;
use crate::rule::contact::slots::Slots;
use crate::rule::contact::slots::row::Row;
use crate::rule::contact::solver::Solver;
use crate::rule::contact::sub_step::SubStep;
use crate::system::System;

/// Computes the accelerations by nonconservative forces for a sub-step with its middle at `time` \[s\] on the world's
/// clock; the arrays stay empty without such forces.
pub(crate) fn find(system: &System, solver: &mut Solver, time: f64) {
    let Solver { slots, held_forces, has_other_forces, .. } = solver;
    slots.working.clear();
    slots.applied.clear();
    if !system.has_nonconservative_forces() {
        return;
    }
    let between = forces_between(system, slots, time);
    for slot in 0..slots.len() {
        let index = slots.index[slot] as usize;
        let inverse_mass = slots.velocity[slot].number();
        let of = |forces: &[DVec3]| forces.get(index).copied().unwrap_or(DVec3::ZERO);
        let (radius, mass) = (system.spheres.radius[index], system.spheres.mass[index]);
        let (linear, _) = forces::nonconservative_linear(system.forces, radius, mass);
        let mut force = of(&between);
        if *has_other_forces {
            let state = SphereState { radius, mass, ..slots.middle_of(slot) };
            force += forces::nonconservative_others(system.forces, &state, time);
        }
        let applied = inverse_mass * (of(&system.spheres.applied_force) - of(held_forces));
        let own = linear.acceleration + inverse_mass * force;
        slots.working.push(Row::new(own + applied, linear.drag_rate));
        slots.applied.push(applied);
    }
}

/// The nonconservative forces between spheres in the middle of a sub-step \[N\], by index; empty where there are none.
fn forces_between(system: &System, slots: &Slots, time: f64) -> Vec<DVec3> {
    let mut forces = Vec::new();
    if system.has_interactions() {
        let [positions, velocities] = &slots.middle;
        system.nonconservative_forces_between([positions, velocities], time, &mut forces);
    }
    forces
}

/// Accounts for the work of the forces that [`find`] found: `F·Δx` along the path of a sphere that contacts touch, and
/// `F·(v + v')/2 h` without contacts, from the velocity v at the start to v' at the end.
pub(crate) fn account(solver: &Solver, sub_step: &SubStep, report: &mut StepReport) {
    let slots = &solver.slots;
    if slots.working.is_empty() {
        return;
    }
    let mut work = ForceWork::default();
    for slot in (0..slots.len()).filter(|&slot| !slots.sleeps[slot]) {
        let (path, against_drag) = path(solver, slot, sub_step);
        let (mass, applied) = (1.0 / slots.velocity[slot].number(), slots.applied[slot]);
        let own = slots.working[slot].vector() - applied;
        work.forces += mass * (own.dot(path) - slots.working[slot].number() * against_drag);
        work.applied += mass * applied.dot(path);
    }
    report.energy_account.add_force_work(work);
}

/// The path of a sphere in the sub-step \[m\], and the integral of the product of its velocity and the one that drag
/// acts on \[m²/s\].
fn path(solver: &Solver, slot: usize, sub_step: &SubStep) -> (DVec3, f64) {
    if let Some(landed) = solver.landings.of(slot) {
        return (landed.path, landed.against_drag);
    }
    let (slots, h) = (&solver.slots, sub_step.h);
    let [before, velocity] = [slots.before[slot], slots.velocity[slot]].map(Row::vector);
    let (mean, free) = (0.5 * (before + velocity), slots.accelerated(slot, h));
    let bounce = solver.bounces.binary_search_by_key(&slot, |bounce| bounce.slot as usize);
    let shift = bounce.map_or(DVec3::ZERO, |place| solver.bounces[place].shift);
    let last = if velocity == free { mean } else { velocity };
    (h * last + shift, h * free.dot(mean))
}
