//! Impacts of a sub-step: what they report, and where spheres bounce.

use glam::DVec3;

use super::batch;
use super::row::Row;
use super::slab::Slab;
use super::slots::Slots;
use super::solver::{Bounce, Solver};
use super::sub_step::SubStep;
use crate::report::{BodyPair, Impact, StepReport};
use crate::system::System;

/// A change of velocity is that of a bounce alone up to this part of it.
const ROUNDING: f64 = 1e-9;

/// Reports the contacts that began with an impact, in order of their bodies.
pub(super) fn report(
    system: &System,
    solver: &Solver,
    sub_step: &SubStep,
    report: &mut StepReport,
) {
    let first = report.impacts.len();
    for slab in solver.slabs.iter() {
        of_pairs(solver, slab, sub_step.time, &mut report.impacts);
        of_surfaces(system, solver, slab, sub_step.time, &mut report.impacts);
    }
    report.impacts[first..].sort_by_key(|impact| impact.between);
}

/// Notes the bounces of spheres that nothing else touches in the sub-step. A sphere that bounces after a time
/// t moves until then as if nothing were there: with the impulse P it is `t P / m` short of where its last
/// velocity takes it in the whole sub-step.
pub(super) fn note_bounces(solver: &mut Solver, sub_step: &SubStep) {
    let Solver { slots, slabs, bounces, .. } = solver;
    bounces.clear();
    if solver.has_other_forces {
        return;
    }
    let slots = &*slots;
    for slab in slabs.iter() {
        for (number, lane, approach) in slab.batches.impacts() {
            let Some(impulse) = slab.batches.bounce(number, lane, approach) else { continue };
            let [first, second] = slab.slots_of(number, lane);
            let radius_sum = slab.batches.approaches[number].radius_sum[lane];
            let offset = slots.position[second].vector() - slots.position[first].vector();
            let normal = DVec3::from_array(batch::get(&slab.batches.pairs[number].normal, lane));
            let time = (offset.dot(normal) - radius_sum).max(0.0) / approach;
            let both = [(first, -impulse), (second, impulse)];
            if let [Some(first), Some(second)] = both.map(|it| bounce(slots, it, time, sub_step)) {
                bounces.extend([first, second]);
            }
        }
        for contact in &slab.surfaces {
            let slot = slab.start + contact.slot as usize;
            if let Some(impulse) = contact.bounce(1.0 / slots.velocity[slot].number()) {
                bounces.extend(bounce(slots, (slot, impulse), contact.time, sub_step));
            }
        }
    }
    bounces.sort_by_key(|bounce| bounce.slot);
}

/// The bounce of a sphere by an impulse \[N s\] after a time \[s\]; `None` if something else changed its
/// velocity.
fn bounce(
    slots: &Slots,
    (slot, impulse): (usize, DVec3),
    time: f64,
    sub_step: &SubStep,
) -> Option<Bounce> {
    let [velocity, before] = [slots.velocity[slot], slots.before[slot]].map(Row::vector);
    let own = slots.velocity[slot].number() * impulse;
    let change = velocity - slots.accelerated(slot, sub_step.h);
    let is_alone =
        (change - own).length_squared() <= (ROUNDING * ROUNDING) * change.length_squared();
    let flight = 0.5 * sub_step.h * (before - (velocity - change));
    is_alone.then(|| Bounce { slot: slot as u32, shift: flight - time * own })
}

fn of_pairs(solver: &Solver, slab: &Slab, time: f64, impacts: &mut Vec<Impact>) {
    for (number, lane, approach_speed) in slab.batches.impacts() {
        let pair = &slab.batches.pairs[number];
        let mut tangential_impulse = slab.batches.tangential_impulse(number, lane);
        let mut normal = DVec3::from_array(batch::get(&pair.normal, lane));
        let [mut first, mut second] = slab.slots_of(number, lane);
        if solver.slots.id[first] > solver.slots.id[second] {
            (first, second, normal) = (second, first, -normal);
            // From zero, for it not to become -0.
            tangential_impulse = DVec3::ZERO - tangential_impulse;
        }
        let at = &solver.slots;
        let relative = at.velocity[second].vector() - at.velocity[first].vector();
        let center = at.position[first];
        impacts.push(Impact {
            time,
            between: BodyPair::Spheres(at.id[first], at.id[second]),
            point: center.vector() + center.number() * normal,
            normal,
            approach_speed,
            separation_speed: relative.dot(normal),
            impulse: pair.impulse[lane],
            tangential_impulse,
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
        let center = solver.slots.position[slot];
        let relative = solver.slots.velocity[slot].vector() - contact.velocity;
        impacts.push(Impact {
            time,
            between: BodyPair::Collider {
                collider: system.surfaces[contact.surface as usize].collider,
                sphere: solver.slots.id[slot],
            },
            point: center.vector() - center.number() * contact.normal,
            normal: contact.normal,
            approach_speed: contact.approach,
            separation_speed: relative.dot(contact.normal),
            impulse: contact.impulses.normal,
            tangential_impulse: DVec3::from_array(contact.impulses.tangential),
        });
    }
}
