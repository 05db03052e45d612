//! Work of nonconservative forces in a sub-step.

use glam::DVec3;

use crate::force_work::ForceWork;
use crate::forces::{self, SphereState};
use crate::report::StepReport;
use crate::rule::contact::slots::row::Row;
use crate::rule::contact::solver::Solver;
use crate::rule::contact::sub_step::SubStep;
use crate::system::System;

/// Computes the accelerations by nonconservative forces for a sub-step with its middle at `time` \[s\] on the world's
/// clock; the arrays stay empty without such forces.
pub(crate) fn find(system: &System, solver: &mut Solver, time: f64) {
    solver.slots.working.clear();
    solver.slots.applied.clear();
    if !system.has_nonconservative_forces() {
        return;
    }
    let forces = Forces::of(system, solver, time);
    let count = solver.slots.len();
    let applied: Vec<DVec3> = (0..count).map(|slot| forces.applied(slot)).collect();
    let working = (0..count).zip(&applied).map(|(slot, &applied)| {
        if solver.slots.is_damped(slot) {
            forces.on_damped(slot)
        } else {
            forces.nonconservative(slot, applied)
        }
    });
    solver.slots.working = working.collect();
    solver.slots.applied = applied;
}

/// Forces in the middle of a sub-step.
struct Forces<'a> {
    system: &'a System<'a>,
    solver: &'a Solver,
    /// On the world's clock \[s\].
    time: f64,
    /// Nonconservative forces between spheres, and all of them \[N\], by index; empty where none are needed.
    between: [Vec<DVec3>; 2],
}

impl<'a> Forces<'a> {
    fn of(system: &'a System<'a>, solver: &'a Solver, time: f64) -> Self {
        let mut between = [Vec::new(), Vec::new()];
        if system.has_interactions() {
            let [positions, velocities] = &solver.slots.middle;
            let states = [&positions[..], &velocities[..]];
            let [nonconservative, all] = &mut between;
            system.nonconservative_forces_between(states, time, nonconservative);
            if solver.slots.are_any_damped() {
                system.forces_between(states, time, all);
            }
        }
        Self { system, solver, time, between }
    }

    /// Acceleration by the force applied to a single sphere \[m/s²\].
    fn applied(&self, slot: usize) -> DVec3 {
        let applied = self.by_index(&self.system.spheres.applied_force, slot);
        self.inverse_mass(slot) * (applied - self.by_index(&self.solver.held_forces, slot))
    }

    /// Acceleration by nonconservative forces \[m/s²\], those of an `applied` one included, and the rate of their
    /// linear drag \[1/s\].
    fn nonconservative(&self, slot: usize, applied: DVec3) -> Row {
        let (forces, [radius, mass]) = (self.system.forces, self.radius_and_mass(slot));
        let (linear, _) = forces::nonconservative_linear(forces, radius, mass);
        let mut force = self.by_index(&self.between[0], slot);
        if self.solver.has_other_forces {
            force += forces::nonconservative_others(forces, &self.state(slot), self.time);
        }
        let own = linear.acceleration + self.inverse_mass(slot) * force;
        Row::new(own + applied, linear.drag_rate)
    }

    /// The same for a sphere with the acceleration of an implicit step: what the other forces leave of it.
    fn on_damped(&self, slot: usize) -> Row {
        let [nonconservative, all] = &self.between;
        let between = self.by_index(all, slot) - self.by_index(nonconservative, slot);
        let own = forces::total_conservative(self.system.forces, &self.state(slot), self.time);
        let others = own + between + self.by_index(&self.solver.held_forces, slot);
        let mean = self.solver.slots.acceleration[slot].vector();
        Row::new(mean - self.inverse_mass(slot) * others, 0.0)
    }

    fn radius_and_mass(&self, slot: usize) -> [f64; 2] {
        let index = self.solver.slots.index[slot] as usize;
        [self.system.spheres.radius[index], self.system.spheres.mass[index]]
    }

    fn state(&self, slot: usize) -> SphereState {
        let [radius, mass] = self.radius_and_mass(slot);
        SphereState { radius, mass, ..self.solver.slots.middle_of(slot) }
    }

    fn inverse_mass(&self, slot: usize) -> f64 {
        self.solver.slots.velocity[slot].number()
    }

    fn by_index(&self, forces: &[DVec3], slot: usize) -> DVec3 {
        let index = self.solver.slots.index[slot] as usize;
        forces.get(index).copied().unwrap_or(DVec3::ZERO)
    }
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
