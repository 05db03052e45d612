//! Neighbours: when they are found anew, and what contacts are made of them.

use std::collections::BTreeSet;

use glam::DVec3;

use super::batch::{ContactKinds, Pair};
use super::kept::Kept;
use super::row::Row;
use super::search::{self, Search};
use super::slab::{self, Slab, Slabs};
use super::slots::{AWAKE, Slots};
use super::solver::{Scratch, Solver};
use super::sub_step::SubStep;
use super::surfaces::{Place, SurfaceContact};
use crate::detect::contact::Bodies;
use crate::detect::sphere_surface;
use crate::detect::surface_tree::Bounds;
use crate::friction::ContactFriction;
use crate::id::SphereId;
use crate::interval::Interval;
use crate::report::StepReport;
use crate::respond::restitution_of;
use crate::surface::Role;
use crate::system::System;

/// Whether a sphere may go farther in this sub-step than the last search allows.
pub(super) fn are_stale(solver: &Solver, sub_step: &SubStep) -> bool {
    let Slots { position, velocity, before, reference, .. } = &solver.slots;
    let leaves = |slot: usize, velocity: DVec3| {
        let end = position[slot].vector() + sub_step.h * velocity;
        let (way, margin) = (end - reference[slot].vector(), reference[slot].number());
        way.length_squared() > margin * margin
    };
    // A flight ends between where its first velocity takes it and where its last one does.
    let may_leave =
        |slot: usize| leaves(slot, velocity[slot].vector()) || leaves(slot, before[slot].vector());
    solver.is_stale || (0..position.len()).any(may_leave)
}

/// Puts spheres into the order of space, finds which may touch, and makes contacts of them, which go on
/// from the impulses that they had.
pub(super) fn search(
    system: &System,
    frame: Interval,
    sub_step: &SubStep,
    solver: &mut Solver,
    scratch: &mut Scratch,
    report: &mut StepReport,
) {
    let collect = || Kept::of(&solver.slots, &solver.slabs, &solver.dormant, &system.spheres.id);
    let kept = &solver.kept.take().unwrap_or_else(collect);
    let Solver { slots, slabs, watched, dormant, .. } = solver;
    solver.is_stale = false;
    arrange(slots, [frame.h, sub_step.h], &mut scratch.search);
    divide(slots, slabs, &scratch.search);
    if !dormant.is_empty() {
        let sleeps: BTreeSet<SphereId> = slots.asleep().collect();
        dormant.retain(|contact| sleeps.contains(&contact.sphere));
    }
    watched.clear();
    if system.settings.spheres_collide {
        scratch.search.find_pairs(slots);
        let pairs = &mut scratch.search.pairs;
        watch_sleepers(slots, pairs, watched);
        add_pairs(system, slots, slabs, kept, solver.kinds, pairs);
    }
    let left = frame.h - sub_step.time;
    for slab in &mut slabs.list {
        let surfaces = Surfaces { system, places: &solver.places, slots, kept, left };
        surfaces.add_to(slab, &mut scratch.near);
    }
    report.work.searches += 1;
    report.work.pair_tests += std::mem::take(&mut scratch.search.tests);
}

/// Sorts spheres by space, and notes from where they may go how far.
fn arrange(slots: &mut Slots, [frame, h]: [f64; 2], search: &mut Search) {
    let count = slots.len();
    // By index, for the order of spheres in one cell not to depend on the order of now.
    let mut slot_of = vec![0; count];
    slots.index.iter().zip(0..).for_each(|(&index, slot)| slot_of[index as usize] = slot);
    let by_index =
        |rows: &[Row]| -> Vec<Row> { slot_of.iter().map(|&slot: &usize| rows[slot]).collect() };
    let (positions, velocities) = (by_index(&slots.position), by_index(&slots.velocity));
    let centers: Vec<DVec3> = positions.iter().map(|row| row.vector()).collect();
    let radii: Vec<f64> = positions.iter().map(|row| row.number()).collect();
    let margins: Vec<f64> = radii
        .iter()
        .zip(&velocities)
        .map(|(&radius, velocity)| search::margin(radius, velocity.vector().length(), frame, h))
        .collect();
    let down = slots.acceleration.first().map_or(DVec3::ZERO, |row| row.vector());
    let order = search.order(&centers, &radii, &margins, down);
    let from: Vec<usize> = order.iter().map(|&index| slot_of[index as usize]).collect();
    slots.reference.clear();
    slots.reference.extend(
        order.iter().map(|&index| Row::new(centers[index as usize], margins[index as usize])),
    );
    slots.permute(&from);
}

/// Divides the slots into slabs, without contacts.
fn divide(slots: &Slots, slabs: &mut Slabs, search: &Search) {
    let starts = search.runs(slab::count(slots.len()));
    slabs.list.resize_with(starts.len() - 1, Slab::default);
    for (slab, bounds) in slabs.list.iter_mut().zip(starts.windows(2)) {
        (slab.start, slab.end) = (bounds[0], bounds[1]);
    }
    slabs.far.end = slots.len();
    let ends: Vec<usize> = slabs.list.iter().map(|slab| slab.end).collect();
    for (number, slab) in slabs.list.iter_mut().enumerate() {
        let end = ends[(number + 1).min(ends.len() - 1)];
        slab.batches.clear(end - slab.start);
        slab.surfaces.clear();
    }
    slabs.far.batches.clear(slots.len());
}

/// Takes out the pairs of which both sleep, and notes those of which one does.
fn watch_sleepers(slots: &Slots, pairs: &mut Vec<[u32; 2]>, watched: &mut Vec<[u32; 2]>) {
    pairs.retain(|&[first, second]| {
        let is_awake = |slot: u32| slots.island[slot as usize] == AWAKE;
        match [is_awake(first), is_awake(second)] {
            [true, true] => {}
            [true, false] => watched.push([second, first]),
            [false, true] => watched.push([first, second]),
            [false, false] => return false,
        }
        true
    });
}

/// Makes contacts of pairs of slots, in the slab of the first one.
fn add_pairs(
    system: &System,
    slots: &Slots,
    slabs: &mut Slabs,
    kept: &Kept,
    kinds: ContactKinds,
    pairs: &[[u32; 2]],
) {
    let Slabs { list, far } = slabs;
    let mut number = 0;
    for &[first, second] in pairs {
        while list[number].end <= first as usize {
            number += 1;
        }
        let next = (number + 1).min(list.len() - 1);
        let slab = if (second as usize) < list[next].end { &mut list[number] } else { &mut *far };
        let indices = [first, second].map(|slot| slots.index[slot as usize]);
        let pair = Pair {
            slots: [first, second].map(|slot| slot - slab.start as u32),
            radii: [first, second].map(|slot| slots.position[slot as usize].number()),
            inverse_masses: [first, second].map(|slot| slots.velocity[slot as usize].number()),
            inverse_inertias: [first, second]
                .map(|slot| slots.spin.get(slot as usize).map_or(0.0, |row| row.number())),
            restitution: restitution_of(Bodies::pair(indices), system),
            friction: friction_of(Bodies::pair(indices), system),
            impulses: kept.of_pair(indices),
        };
        slab.batches.push(&pair, kinds);
    }
}

/// Friction of a contact, from that of its bodies.
fn friction_of(bodies: Bodies, system: &System) -> ContactFriction {
    let of_sphere = |sphere: u32| system.spheres.friction(sphere as usize);
    let both = match bodies {
        Bodies::Pair(first, second) => [of_sphere(first), of_sphere(second)],
        Bodies::Surface { sphere, surface } => {
            [system.surfaces[surface as usize].friction, of_sphere(sphere)]
        }
    };
    ContactFriction::of(both, system.settings.friction_combine_rule)
}

/// What contacts with surfaces are made of.
#[derive(Clone, Copy)]
struct Surfaces<'a> {
    system: &'a System<'a>,
    places: &'a [Place],
    slots: &'a Slots,
    kept: &'a Kept,
    /// What is left of the frame \[s\].
    left: f64,
}

impl Surfaces<'_> {
    /// Makes contacts of the spheres of a slab with the surfaces that they may touch until the next
    /// search.
    fn add_to(&self, slab: &mut Slab, near: &mut Vec<u32>) {
        let Self { system, slots, .. } = *self;
        let awake = (slab.start..slab.end).filter(|&slot| slots.island[slot] == AWAKE);
        for slot in awake {
            let (center, radius) = (slots.position[slot].vector(), slots.position[slot].number());
            let margin = slots.reference[slot].number();
            let bounds = Bounds::around(center, DVec3::splat(radius + margin));
            system.tree.near(&bounds, near);
            self.add_moving(near);
            for &surface in near.iter() {
                if self.may_touch(slot, surface) {
                    let relative = (slot - slab.start) as u32;
                    slab.surfaces.push(self.contact(slot, relative, surface));
                }
            }
        }
    }

    /// Adds the surfaces that move, whose bounds are those of the start of the frame.
    fn add_moving(&self, near: &mut Vec<u32>) {
        let moves = |number: &u32| !self.places[*number as usize].1.is_at_rest();
        if self.places.iter().any(|place| !place.1.is_at_rest()) {
            near.extend((0..self.places.len() as u32).filter(moves));
            near.sort_unstable();
            near.dedup();
        }
    }

    /// Whether a sphere and a surface may touch until the next search, or the end of the frame.
    fn may_touch(&self, slot: usize, surface: u32) -> bool {
        if self.system.surfaces[surface as usize].role != Role::Deflects {
            return false;
        }
        let (center, radius) =
            (self.slots.position[slot].vector(), self.slots.position[slot].number());
        let margin = self.slots.reference[slot].number();
        let (form, motion) = &self.places[surface as usize];
        let arm = (center - motion.origin).length() + radius + margin;
        let speed = motion.velocity.length() + motion.angular_velocity.length() * arm;
        // From behind a rectangle, a sphere may come round its edge.
        let separation = sphere_surface(form, center, radius);
        separation.is_none_or(|it| it.distance <= margin + speed * self.left)
    }

    fn contact(&self, slot: usize, relative: u32, surface: u32) -> SurfaceContact {
        let sphere = self.slots.index[slot];
        let bodies = Bodies::Surface { sphere, surface };
        let restitution = restitution_of(bodies, self.system);
        let friction = friction_of(bodies, self.system);
        let mut contact = SurfaceContact::new(relative, surface, restitution, friction);
        contact.impulses = self.kept.of_surface(sphere, surface);
        contact
    }
}
