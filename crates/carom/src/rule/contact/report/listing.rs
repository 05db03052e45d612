//! The list of the contacts of a world.

use glam::DVec3;

use crate::detect::{Separation, sphere_sphere, sphere_surface};
use crate::id::SphereId;
use crate::persistent_contact::PersistentContact;
use crate::report::BodyPair;
use crate::rule::contact::contacts::batch::{self, Impulses};
use crate::rule::contact::contacts::dormant::{Dormant, Partner};
use crate::rule::contact::slabs::Slab;
use crate::rule::contact::solver::Solver;
use crate::system::System;

/// A contact slides where the tangential impulse is at least this part of the largest possible.
const SLIDES: f64 = 1.0 - 1e-9;

/// The contacts that pressed in the last sub-step, in the order of their bodies, pairs of spheres first.
pub(crate) fn persistent_contacts(solver: &Solver, system: &System) -> Vec<PersistentContact> {
    if solver.is_changed {
        return Vec::new();
    }
    let mut contacts = Vec::new();
    of_pairs(solver, system, &mut contacts);
    of_surfaces(solver, system, &mut contacts);
    of_sleepers(solver, system, &mut contacts);
    contacts.sort_by_key(|contact| contact.between);
    contacts
}

fn of_pairs(solver: &Solver, system: &System, contacts: &mut Vec<PersistentContact>) {
    for slab in solver.slabs.iter() {
        for (number, lane, slots) in slab.batches.contacts() {
            let pair = &slab.batches.pairs[number];
            if pair.impulse[lane] <= 0.0 {
                continue;
            }
            let friction = slab.batches.frictions.get(number);
            let tangential = friction.map_or([0.0; 3], |it| batch::get(&it.tangential, lane));
            let impulses =
                Impulses { normal: pair.impulse[lane], tangential, ..Impulses::default() };
            let slots = slots.map(|slot| slab.start + slot as usize);
            if slots.iter().all(|&slot| solver.slots.sleeps[slot]) {
                continue;
            }
            let sliding = friction.map_or(0.0, |it| it.sliding[lane]);
            contacts.push(of_pair((solver, system), slots, impulses, sliding));
        }
    }
}

/// The contact of the spheres in two slots, with the impulses on the second.
fn of_pair(
    (solver, system): (&Solver, &System),
    [mut first, mut second]: [usize; 2],
    mut impulses: Impulses,
    sliding: f64,
) -> PersistentContact {
    let slots = &solver.slots;
    if slots.id[first] > slots.id[second] {
        (first, second, impulses) = (second, first, impulses.reversed());
    }
    let radii = slots.contact_radii([first, second], system);
    let from = slots.place(first);
    let separation = sphere_sphere([from, slots.image_near(second, from)], radii);
    PersistentContact {
        between: BodyPair::Spheres(slots.id[first], slots.id[second]),
        ..of_separation(separation, forces(impulses, sliding, solver.h))
    }
}

fn of_surfaces(solver: &Solver, system: &System, contacts: &mut Vec<PersistentContact>) {
    for slab in solver.slabs.iter() {
        for contact in slab.surfaces.iter().filter(|it| it.impulses.normal > 0.0) {
            let slot = slab.start + contact.slot as usize;
            if solver.slots.sleeps[slot] {
                continue;
            }
            let forces = forces(contact.impulses, contact.friction.sliding, solver.h);
            contacts.extend(of_surface(solver, system, (slot, contact.surface), forces));
        }
    }
}

/// The contact of the sphere in a slot with a surface; `None` where it has gone behind it.
fn of_surface(
    solver: &Solver,
    system: &System,
    (slot, surface): (usize, u32),
    forces: PersistentContact,
) -> Option<PersistentContact> {
    let slots = &solver.slots;
    let (center, radius) = (slots.position[slot].vector(), slots.position[slot].number());
    let (own, shift) = solver.places.image(surface);
    let surface = &system.surfaces[own as usize];
    let mut separation = sphere_surface(&surface.form, center - shift, radius)?;
    if shift != DVec3::ZERO || slots.place(slot) != center {
        separation.point += shift + (slots.place(slot) - center);
    }
    Some(PersistentContact {
        between: BodyPair::Collider { collider: surface.collider, sphere: slots.id[slot] },
        ..of_separation(separation, forces)
    })
}

/// The contacts of spheres that sleep, with the forces with which they fell asleep.
fn of_sleepers(solver: &Solver, system: &System, contacts: &mut Vec<PersistentContact>) {
    for &Dormant { sphere, partner, impulses, sliding, .. } in &solver.dormant {
        let slot = sphere as usize;
        match partner {
            Partner::Sphere(other) => {
                contacts.push(of_pair((solver, system), [other as usize, slot], impulses, sliding));
            }
            // It is among the others.
            Partner::Awake(_) => {}
            Partner::Surface(surface) => {
                let forces = forces(impulses, sliding, solver.h);
                contacts.extend(of_surface(solver, system, (slot, surface), forces));
            }
        }
    }
}

fn of_separation(separation: Separation, forces: PersistentContact) -> PersistentContact {
    let Separation { distance, normal, point } = separation;
    PersistentContact { point, normal, gap: distance, ..forces }
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

/// The spheres on their way through surfaces that are open from behind, with these surfaces.
pub(crate) fn passages(solver: &Solver) -> Vec<(SphereId, u32)> {
    if solver.is_changed {
        return Vec::new();
    }
    let of_slab = |slab: &Slab| {
        let passing = slab.surfaces.iter().filter(|contact| contact.passes);
        let start = slab.start;
        let passages = passing.map(move |it| (start + it.slot as usize, it.surface));
        passages.collect::<Vec<_>>()
    };
    let all = solver.slabs.iter().flat_map(of_slab);
    all.map(|(slot, surface)| (solver.slots.id[slot], solver.places.image(surface).0)).collect()
}
