//! Which open surfaces spheres pass in a sub-step.

use super::surfaces::SurfaceContact;
use crate::detect::{passage, sphere_surface};
use crate::rule::contact::places::Places;
use crate::rule::contact::slots::Run;
use crate::surface::Form;

/// Overlap, as a part of the radius, from which on a sphere that passes one part of an open mesh passes another one:
/// more than pressing leaves.
const JOINED: f64 = 1e-2;

/// Notes which surfaces the spheres of a run pass: the open ones that they are behind, and those that they passed
/// before and still overlap. While a sphere passes a part of an open mesh it passes the parts around, except those on
/// which it presses or which it hardly overlaps.
pub(crate) fn find(run: &Run, contacts: &mut [SurfaceContact], places: &Places) {
    if !places.any_open {
        return;
    }
    for own in contacts.chunk_by_mut(|first, second| first.slot == second.slot) {
        find_of_sphere(run, own, places);
    }
}

/// Notes which surfaces the sphere of these contacts passes.
fn find_of_sphere(run: &Run, own: &mut [SurfaceContact], places: &Places) {
    let mut passes_mesh = false;
    for contact in &mut *own {
        if contact.is_clear(run, run.position[contact.slot as usize].vector(), 0.0) {
            contact.passes = false;
            continue;
        }
        let (form, _) = places.at_start(contact.surface);
        contact.passes = form.is_open() && passes_by_itself(run, contact, form);
        passes_mesh |= contact.passes && form.is_feature();
    }
    if !passes_mesh {
        return;
    }
    for contact in own {
        let (form, _) = places.at_start(contact.surface);
        let is_part = form.is_open() && form.is_feature();
        contact.passes |= is_part && may_pass(run, contact, form);
    }
}

/// Whether a sphere passes an open surface, whatever is around.
fn passes_by_itself(run: &Run, contact: &SurfaceContact, form: &Form) -> bool {
    let row = run.position[contact.slot as usize];
    let (center, radius) = (row.vector(), row.number());
    let overlaps = || sphere_surface(form, center, radius).is_some_and(|it| it.distance < 0.0);
    let still_passes = contact.passes && contact.impulses.normal == 0.0 && overlaps();
    still_passes || passage::is_behind(form, center, radius)
}

/// Whether a sphere does not press on a part of a mesh, and is elsewhere or overlaps it deeply.
fn may_pass(run: &Run, contact: &SurfaceContact, form: &Form) -> bool {
    let row = run.position[contact.slot as usize];
    let separation = sphere_surface(form, row.vector(), row.number());
    let is_deep = separation.is_none_or(|it| it.distance < -JOINED * row.number());
    is_deep && contact.impulses.normal == 0.0
}
