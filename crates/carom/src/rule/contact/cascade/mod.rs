//! Cascades: where a sphere strikes a body that touches something else, or reaches a second body after its first
//! impact, an island of spheres repeats the sub-step, from impact to impact in order of time.
//!
//! The sweeps answer all impacts of a sub-step together, as if they came at one time, and take what a few of
//! them leave for solved. In a heap that is good enough, for much is lost there anyway. Elastic bounces
//! would lose or gain by it, and impacts that follow each other would be mixed.

mod body;
mod course;
mod island;
mod link;
mod met;
mod pieces;

use glam::DMat3;

use super::contacts::batch::Impulses;
use super::contacts::swept::FREE;
use super::solver::Solver;
use super::sub_step::SubStep;
use crate::report::StepReport;
use crate::system::System;
use island::{Gathering, Island};

/// Follows the cascades about the spheres in these slots. Until they [`land`], their spheres move as if nothing
/// touched them.
pub(super) fn follow(
    system: &System,
    solver: &mut Solver,
    seeds: &[usize],
    sub_step: &SubStep,
    report: &mut StepReport,
) {
    solver.landings.spheres.clear();
    solver.landings.contacts.clear();
    if seeds.is_empty() {
        return;
    }
    solver.incidence.renew(&solver.slabs, solver.slots.len());
    let mut gathering = Gathering::among(solver.slots.len());
    seeds.iter().for_each(|&seed| gathering.gather(solver, seed, sub_step));
    for mut island in gathering.into_islands() {
        island.links.iter_mut().for_each(|link| link.bears = link.pressed());
        let Some(course) = pieces::follow(&mut island, &solver.places, sub_step) else {
            continue;
        };
        report.energy_account.contacts += course.work;
        if solver.kinds.shear {
            *report.virial.get_or_insert(DMat3::ZERO) += course.virial;
        }
        let impacts = course.impacts.iter().map(|it| it.report(system, solver, sub_step));
        report.impacts.extend(impacts);
        withdraw(solver, &island, sub_step);
    }
    solver.landings.spheres.sort_unstable_by_key(|landed| landed.slot);
}

/// Removes an island from the spheres and contacts that the sweeps work on.
fn withdraw(solver: &mut Solver, island: &Island, sub_step: &SubStep) {
    let Solver { slots, slabs, landings, .. } = solver;
    for body in island.bodies.iter().filter(|body| body.inverse_mass > 0.0) {
        let slot = body.slot as usize;
        let free = slots.accelerated(slot, sub_step.h);
        slots.velocity[slot] = slots.velocity[slot].with_vector(free);
        if let Some(spin) = slots.spin.get_mut(slot) {
            *spin = slots.spin_before[slot];
        }
        landings.spheres.push(body.landed());
    }
    for link in &island.links {
        landings.contacts.push((link.origin, link.kept(&island.bodies, sub_step)));
        link.origin.set(slabs, Impulses::default(), FREE);
    }
}

/// Writes the last velocities of the spheres of cascades, and the impulses from which their contacts start the
/// next sub-step.
pub(super) fn land(solver: &mut Solver) {
    let Solver { slots, slabs, landings, .. } = solver;
    for landed in &landings.spheres {
        let slot = landed.slot as usize;
        slots.velocity[slot] = slots.velocity[slot].with_vector(landed.velocity);
        if let Some(spin) = slots.spin.get_mut(slot) {
            *spin = spin.with_vector(landed.spin);
        }
    }
    for &(origin, kept) in &landings.contacts {
        origin.set(slabs, kept, 0.0);
    }
}
