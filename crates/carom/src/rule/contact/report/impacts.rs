//! Reports of the impacts of a sub-step.

use glam::DVec3;

use crate::report::{BodyPair, Impact, StepReport};
use crate::rule::contact::slabs::Slab;
use crate::rule::contact::solver::Solver;
use crate::rule::contact::sub_step::SubStep;
use crate::system::System;

/// Reports the contacts that began with an impact, in order of their bodies, with those reported already from
/// the `first` on.
pub(crate) fn report(
    system: &System,
    solver: &Solver,
    sub_step: &SubStep,
    first: usize,
    report: &mut StepReport,
) {
    for slab in solver.slabs.iter() {
        of_pairs((system, solver), slab, sub_step.time, &mut report.impacts);
        of_surfaces(system, solver, slab, sub_step.time, &mut report.impacts);
    }
    report.impacts[first..].sort_by_key(|impact| impact.between);
}

fn of_pairs(
    (system, solver): (&System, &Solver),
    slab: &Slab,
    time: f64,
    impacts: &mut Vec<Impact>,
) {
    for (number, lane, approach_speed) in slab.batches.impacts() {
        let pair = &slab.batches.pairs[number];
        let mut tangential_impulse = slab.batches.tangential_impulse(number, lane);
        let mut normal = slab.batches.normal(number, lane);
        let mut slide = slab.batches.slide(number, lane);
        let [mut first, mut second] = slab.slots_of(number, lane);
        if solver.landings.has(first) || solver.landings.has(second) {
            continue;
        }
        if solver.slots.id[first] > solver.slots.id[second] {
            (first, second, normal, slide) = (second, first, -normal, -slide);
            // Subtracted from zero, so that zero does not become -0.
            tangential_impulse = DVec3::ZERO - tangential_impulse;
        }
        let at = &solver.slots;
        let mut relative = at.velocity[second].vector() - at.velocity[first].vector();
        relative.x += slide;
        let [radius, _] = at.contact_radii([first, second], system);
        impacts.push(Impact {
            time,
            between: BodyPair::Spheres(at.id[first], at.id[second]),
            point: at.place(first) + radius * normal,
            normal,
            approach_speed,
            separation_speed: relative.dot(normal),
            impulse: pair.impulse[lane],
            tangential_impulse,
            kick: 0.0,
        });
    }
}

fn of_surfaces(
    system: &System,
    solver: &Solver,
    slab: &Slab,
    time: f64,
    impacts: &mut Vec<Impact>,
) {
    for contact in &slab.surfaces {
        if contact.approach <= 0.0 || contact.impulses.normal <= 0.0 {
            continue;
        }
        let slot = slab.start + contact.slot as usize;
        if solver.landings.has(slot) {
            continue;
        }
        let center = solver.slots.position[slot];
        let relative = solver.slots.velocity[slot].vector() - contact.velocity;
        let own = solver.places.surface_of(contact.surface);
        impacts.push(Impact {
            time,
            between: BodyPair::Collider {
                collider: system.surfaces[own as usize].collider,
                sphere: solver.slots.id[slot],
            },
            point: solver.slots.place(slot) - center.number() * contact.normal,
            normal: contact.normal,
            approach_speed: contact.approach,
            separation_speed: relative.dot(contact.normal),
            impulse: contact.impulses.normal,
            tangential_impulse: DVec3::from_array(contact.impulses.tangential),
            kick: contact.kicked,
        });
    }
}
