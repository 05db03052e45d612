//! The contacts of a world, as they are listed.

use glam::DVec3;

use super::batch::{self, Impulses};
use super::solver::Solver;
use crate::detect::sphere_surface;
use crate::persistent_contact::PersistentContact;
use crate::report::BodyPair;
use crate::system::System;

/// A contact slides whose tangential impulse is this part of the largest possible one at least.
const SLIDES: f64 = 1.0 - 1e-9;

/// The contacts that bore something in the last sub-step, in order of their bodies, pairs of spheres
/// first.
pub(crate) fn persistent_contacts(solver: &Solver, system: &System) -> Vec<PersistentContact> {
    if solver.is_stale {
        return Vec::new();
    }
    let mut contacts = Vec::new();
    of_pairs(solver, &mut contacts);
    of_surfaces(solver, system, &mut contacts);
    contacts.sort_by_key(|contact| contact.between);
    contacts
}

fn of_pairs(solver: &Solver, contacts: &mut Vec<PersistentContact>) {
    let slots = &solver.slots;
    for slab in solver.slabs.iter() {
        for (number, lane, [first, second]) in slab.batches.contacts() {
            let pair = &slab.batches.pairs[number];
            if pair.impulse[lane] <= 0.0 {
                continue;
            }
            let friction = slab.batches.frictions.get(number);
            let tangential = friction.map_or([0.0; 3], |it| batch::get(&it.tangential, lane));
            let impulses =
                Impulses { normal: pair.impulse[lane], tangential, ..Impulses::default() };
            let [mut first, mut second] = [first, second].map(|slot| slab.start + slot as usize);
            let is_reversed = slots.id[first] > slots.id[second];
            if is_reversed {
                (first, second) = (second, first);
            }
            let [from, to] = [first, second].map(|slot| slots.position[slot]);
            let offset = to.vector() - from.vector();
            let length = offset.length();
            let normal = if length > 0.0 { offset / length } else { DVec3::Y };
            contacts.push(PersistentContact {
                between: BodyPair::Spheres(slots.id[first], slots.id[second]),
                point: from.vector() + from.number() * normal,
                normal,
                gap: length - (from.number() + to.number()),
                ..forces(
                    if is_reversed { impulses.reversed() } else { impulses },
                    friction.map_or(0.0, |it| it.sliding[lane]),
                    solver.h,
                )
            });
        }
    }
}

fn of_surfaces(solver: &Solver, system: &System, contacts: &mut Vec<PersistentContact>) {
    let slots = &solver.slots;
    for slab in solver.slabs.iter() {
        for contact in &slab.surfaces {
            let slot = slab.start + contact.slot as usize;
            let (center, radius) = (slots.position[slot].vector(), slots.position[slot].number());
            let surface = &system.surfaces[contact.surface as usize];
            let separation = sphere_surface(&surface.form, center, radius);
            let Some(separation) = separation.filter(|_| contact.impulses.normal > 0.0) else {
                continue;
            };
            contacts.push(PersistentContact {
                between: BodyPair::Collider { collider: surface.collider, sphere: slots.id[slot] },
                point: separation.point,
                normal: separation.normal,
                gap: separation.distance,
                ..forces(contact.impulses, contact.friction.sliding, solver.h)
            });
        }
    }
}

/// The forces of a contact that had these impulses in a sub-step of `h` \[s\].
fn forces(impulses: Impulses, sliding: f64, h: f64) -> PersistentContact {
    let tangential = DVec3::from_array(impulses.tangential);
    PersistentContact {
        normal_force: impulses.normal / h,
        tangential_force: tangential / h,
        is_sliding: tangential.length() >= SLIDES * sliding * impulses.normal,
        ..PersistentContact::NONE
    }
}
