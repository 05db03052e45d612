//! Finding contacts among many spheres, at one instant.

use std::ops::ControlFlow;

use glam::DVec3;

use super::broad_phase::BroadPhase;
use super::contact::{Bodies, Contact};
use super::instant::Instant;
use super::{ContactState, sphere_surface};
use crate::bounds::Bounds;
use crate::surface::{Form, Role, Surface};
use crate::system::System;

/// Up to this many spheres all pairs are tested: sorting would not pay off.
const FEW: usize = 16;

/// Working memory of the searches below; only the sorted spheres that [`find_all`] leaves are kept for
/// [`find_of_moved`].
#[derive(Debug, Clone, Default)]
pub(crate) struct Search {
    all_spheres: BroadPhase,
    selection: BroadPhase,
    near: Vec<u32>,
    /// Pairs of spheres that were tested since the count was last taken.
    pair_tests: u64,
}

impl Search {
    /// Returns the number of pairs of spheres tested since the last call.
    pub fn take_pair_tests(&mut self) -> u64 {
        std::mem::take(&mut self.pair_tests)
    }
}

/// Contacts that are not `Separate` among all spheres and solid surfaces, sorted by bodies.
pub(crate) fn find_all(
    instant: &Instant,
    tolerance: f64,
    search: &mut Search,
    contacts: &mut Vec<Contact>,
) {
    contacts.clear();
    let count = instant.system.spheres.id.len() as u32;
    if instant.system.settings.spheres_collide {
        search.all_spheres.rebuild((0..count).map(|i| sphere_at(instant, i)), tolerance);
        search.all_spheres.for_each_pair(|i, j| {
            search.pair_tests += 1;
            add_pair(instant, [i, j], tolerance, contacts);
        });
    }
    find_with_surfaces(instant, 0..count, tolerance, &mut search.near, contacts);
    contacts.sort_unstable_by_key(|contact| contact.bodies);
}

/// Pairs of spheres that overlap by more than `tolerance`, however they move, sorted by bodies.
pub(crate) fn find_overlapping_pairs(
    instant: &Instant,
    tolerance: f64,
    search: &mut Search,
    contacts: &mut Vec<Contact>,
) {
    contacts.clear();
    if !instant.system.settings.spheres_collide {
        return;
    }
    let mut pair_tests = 0;
    let mut keep = |i, j| {
        pair_tests += 1;
        let contact = instant.pair(i, j, 0.0);
        if contact.separation.distance < -tolerance && instant.system.spheres_meet(i, j) {
            contacts.push(contact);
        }
    };
    let all = 0..instant.system.spheres.id.len() as u32;
    for_each_candidate(instant, all, 0.0, &mut search.selection, &mut keep);
    search.pair_tests += pair_tests;
    contacts.sort_unstable_by_key(|contact| contact.bodies);
}

/// Visits pairs of spheres, then spheres and solid surfaces, that overlap by more than
/// `tolerance`, however they move.
pub(crate) fn visit_overlaps(
    instant: &Instant,
    tolerance: f64,
    search: &mut Search,
    mut visit: impl FnMut(&Contact),
) {
    let mut pairs = Vec::new();
    find_overlapping_pairs(instant, tolerance, search, &mut pairs);
    pairs.iter().for_each(&mut visit);
    visit_overlapping_surfaces(instant, tolerance, search, visit);
}

/// Finds two spheres that overlap, however they move, and for which `is_sought` holds, without a list of all.
pub(crate) fn find_overlapping_pair(
    instant: &Instant,
    search: &mut Search,
    mut is_sought: impl FnMut(&Contact) -> bool,
) -> Option<Contact> {
    if !instant.system.settings.spheres_collide {
        return None;
    }
    let all = 0..instant.system.spheres.id.len() as u32;
    search.selection.rebuild(all.map(|i| sphere_at(instant, i)), 0.0);
    let found = search.selection.try_for_each_pair(|i, j| {
        let contact = instant.pair(i, j, 0.0);
        let overlaps = contact.separation.distance < 0.0 && instant.system.spheres_meet(i, j);
        let is_found = overlaps && is_sought(&contact);
        if is_found { ControlFlow::Break(contact) } else { ControlFlow::Continue(()) }
    });
    found.break_value()
}

/// Visits spheres and solid surfaces that overlap by more than `tolerance`, however they move.
pub(crate) fn visit_overlapping_surfaces(
    instant: &Instant,
    tolerance: f64,
    search: &mut Search,
    mut visit: impl FnMut(&Contact),
) {
    for sphere in 0..instant.system.spheres.id.len() as u32 {
        instant.for_each_surface(
            sphere,
            0.0,
            (instant.system.tree, &mut search.near),
            |role| role != Role::Reports,
            |contact| {
                if contact.separation.distance < -tolerance {
                    visit(&contact);
                }
            },
        );
    }
}

/// Collects the contacts that are not `Separate`, between these spheres, and between them and solid surfaces.
pub(crate) fn find_among(
    instant: &Instant,
    members: &[u32],
    tolerance: f64,
    search: &mut Search,
    contacts: &mut Vec<Contact>,
) {
    contacts.clear();
    if instant.system.settings.spheres_collide {
        let members = members.iter().copied();
        for_each_candidate(instant, members, tolerance, &mut search.selection, |i, j| {
            search.pair_tests += 1;
            add_pair(instant, [i, j], tolerance, contacts);
        });
    }
    find_with_surfaces(instant, members.iter().copied(), tolerance, &mut search.near, contacts);
    contacts.sort_unstable_by_key(|contact| contact.bodies);
}

/// Visits the pairs among some spheres that may be at most `tolerance` \[m\] apart. More than a few
/// spheres are arranged in `broad_phase` for it.
fn for_each_candidate(
    instant: &Instant,
    spheres: impl ExactSizeIterator<Item = u32> + Clone,
    tolerance: f64,
    broad_phase: &mut BroadPhase,
    mut visit: impl FnMut(u32, u32),
) {
    if spheres.len() > FEW {
        broad_phase.rebuild(spheres.map(|i| sphere_at(instant, i)), tolerance);
        broad_phase.for_each_pair(visit);
        return;
    }
    let mut rest = spheres;
    while let Some(i) = rest.next() {
        rest.clone().for_each(|j| visit(i, j));
    }
}

/// Spheres that moved since [`find_all`].
pub(crate) struct Moved<'a> {
    pub list: &'a [u32],
    pub contains: &'a dyn Fn(u32) -> bool,
}

/// Contacts that are not `Separate` of moved spheres with all others and with solid surfaces, in no
/// useful order.
pub(crate) fn find_of_moved(
    instant: &Instant,
    moved: &Moved,
    tolerance: f64,
    search: &mut Search,
    contacts: &mut Vec<Contact>,
) {
    find_among(instant, moved.list, tolerance, search, contacts);
    if instant.system.settings.spheres_collide {
        let Search { all_spheres, selection, pair_tests, .. } = search;
        if moved.list.len() <= FEW {
            // More than a few are arranged already, by the search among themselves.
            selection.rebuild(moved.list.iter().map(|&i| sphere_at(instant, i)), tolerance);
        }
        all_spheres.for_each_pair_with(selection, |i, j| {
            if !(moved.contains)(i) {
                *pair_tests += 1;
                add_pair(instant, [i, j], tolerance, contacts);
            }
        });
    }
}

/// Whether a sphere at `center` with `radius` \[m\] touches or overlaps a solid surface.
pub(crate) fn meets_surface(system: &System, center: DVec3, radius: f64) -> bool {
    let mut near = Vec::new();
    system.tree.near(&Bounds::around(center, DVec3::splat(radius)), &mut near);
    near.iter().map(|&index| &system.surfaces[index as usize]).any(|surface| {
        let separation = sphere_surface(&surface.form, center, radius);
        surface.role != Role::Reports
            && separation.is_some_and(|separation| separation.distance <= 0.0)
    })
}

/// Contacts of all spheres with triggers: at most `tolerance` \[m\] apart, whichever way they move.
pub(crate) fn visit_triggers(
    instant: &Instant,
    tolerance: f64,
    search: &mut Search,
    mut visit: impl FnMut(Contact),
) {
    let triggers = instant.system.trigger_tree;
    if triggers.is_empty() {
        return;
    }
    for sphere in 0..instant.system.spheres.id.len() as u32 {
        instant.for_each_surface(
            sphere,
            tolerance,
            (triggers, &mut search.near),
            |_| true,
            |contact| {
                if contact.separation.distance <= tolerance {
                    visit(contact);
                }
            },
        );
    }
}

fn find_with_surfaces(
    instant: &Instant,
    members: impl Iterator<Item = u32>,
    tolerance: f64,
    near: &mut Vec<u32>,
    contacts: &mut Vec<Contact>,
) {
    if instant.system.surfaces.is_empty() {
        return;
    }
    for sphere in members {
        let first = contacts.len();
        instant.for_each_surface(
            sphere,
            tolerance,
            (instant.system.tree, near),
            |role| role == Role::Deflects,
            |contact| {
                let own = contacts[first..].iter_mut();
                match own.into_iter().find(|it| are_flush(instant.system, [&**it, &contact])) {
                    Some(other) if contact.separation.distance < other.separation.distance => {
                        *other = contact;
                    }
                    Some(_) => {}
                    None => add_unless_separate(contact, contacts),
                }
            },
        );
    }
}

/// Angle \[rad\] between the normals of flush faces, at most, rounding included.
const FLUSH: f64 = 2e-9;

/// Returns whether two contacts of a sphere are with flush faces, so that it is above their seam.
fn are_flush(system: System, contacts: [&Contact; 2]) -> bool {
    let [one, other] = contacts.map(|contact| match contact.bodies {
        Bodies::Surface { surface, .. } => Some(&system.surfaces[surface as usize]),
        Bodies::Pair(..) => None,
    });
    let is_face = |it: &Surface| matches!(it.form, Form::Facet(_) | Form::HalfSpace { .. });
    let are_joined = one
        .zip(other)
        .is_some_and(|(one, other)| one.whole == other.whole && is_face(one) && is_face(other));
    let [one, other] = contacts.map(|it| it.separation.normal);
    are_joined && (one - other).length_squared() <= FLUSH * FLUSH
}

fn sphere_at(instant: &Instant, i: u32) -> (u32, DVec3, f64) {
    (i, instant.motion.position[i as usize], instant.system.reach_of(i))
}

fn add_pair(instant: &Instant, [i, j]: [u32; 2], tolerance: f64, contacts: &mut Vec<Contact>) {
    if instant.system.spheres_meet(i, j) {
        add_unless_separate(instant.pair(i, j, tolerance), contacts);
    }
}

fn add_unless_separate(contact: Contact, contacts: &mut Vec<Contact>) {
    if contact.state != ContactState::Separate {
        contacts.push(contact);
    }
}
