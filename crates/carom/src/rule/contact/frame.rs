//! The beginning and the end of a frame: from the world to the solver, and back.

use super::contacts::batch::ContactKinds;
use super::contacts::dormant;
use super::contacts::materials::Materials;
use super::slabs::warm_start::WarmStart;
use super::sleep;
use super::sleep::wake;
use super::slots::row::Row;
use super::slots::slab_totals::SlabTotals;
use super::solver::Solver;
use crate::bodies::Motion;
use crate::friction::Friction;
use crate::report::StepReport;
use crate::rotation;
use crate::shear::Shear;
use crate::system::System;

/// Copies spheres, forces and surfaces from the world, for a frame of `h` \[s\].
pub(super) fn begin(system: &System, motion: &mut Motion, h: f64, solver: &mut Solver) {
    let ids = &system.spheres.id;
    let kinds = kinds_of(system);
    solver.has_moving_surfaces = system.has_moving_surfaces();
    solver.has_belts = kinds.friction && system.has_belts();
    let are_surfaces_changed = solver.is_changed;
    if solver.is_changed || solver.has_moving_surfaces || !system.spheres.applied_force.is_empty() {
        wake::all(solver);
    }
    if solver.is_changed || !solver.slots.are_of(ids) || solver.kinds != kinds {
        solver.slots.follow(ids);
        wake::bereft(solver);
        let mut warm_start = WarmStart::default();
        // They are to be in slots by their index.
        let index_of = |slot: usize| solver.slots.index[slot];
        warm_start.collect(&solver.slabs, ids.len(), index_of);
        warm_start.collect_dormant(solver.dormant.iter(), ids.len(), index_of);
        solver.warm_start = Some(warm_start);
        dormant::renumber(&mut solver.dormant, index_of);
        solver.slots.arrange(ids);
        // These are by slot; the search makes them again.
        solver.watched.clear();
        solver.slabs.make_one(ids.len());
        solver.materials = Materials::of(system);
        if solver.is_changed {
            solver.places.forget_images();
        }
        (solver.kinds, solver.is_stale, solver.is_changed) = (kinds, true, false);
    }
    if kinds.friction || !motion.spin.angular_velocity.is_empty() {
        motion.spin.make_room(ids.len());
    }
    solver.slots.period = system.settings.boundary.period();
    solver.slots.factor = system.material_pairs.non_additivity.largest();
    solver.slots.shear = Shear::of(system.settings);
    solver.slots.read(system, motion, kinds.friction);
    solver.smallest_radius = system.spheres.radius.iter().copied().fold(f64::INFINITY, f64::min);
    solver.has_other_forces = solver.slots.read_forces(system);
    let accelerations = &solver.slots.acceleration;
    let is_one = accelerations.windows(2).all(|two| two[0] == two[1]);
    let first = accelerations.first().copied().unwrap_or_default();
    let is_common = is_one && first.number() == 0.0 && !solver.has_other_forces;
    solver.common_acceleration = is_common.then(|| first.vector());
    solver.may_sleep = !solver.has_other_forces
        && !solver.kinds.shear
        && !solver.has_moving_surfaces
        && system.spheres.applied_force.is_empty();
    // Bounds of moving surfaces are present ones.
    solver.is_stale |= solver.has_moving_surfaces;
    solver.places.begin_frame(system.colliders.shared_surfaces(), h, are_surfaces_changed);
}

/// Copies from the world what the solver does not have from the frame before, which wrote it to the world.
pub(super) fn go_on(system: &System, motion: &mut Motion, h: f64, solver: &mut Solver) {
    let is_known = !(solver.is_stale
        || solver.is_changed
        || solver.has_moving_surfaces
        || solver.has_other_forces
        || !system.spheres.applied_force.is_empty());
    if is_known && solver.slots.are_of(&system.spheres.id) {
        if !solver.places.are_of(system.surfaces) {
            // A snapshot that was read does not hold them.
            solver.places.begin_frame(system.colliders.shared_surfaces(), h, false);
        }
        solver.slots.turn.fill(Row::default());
    } else {
        begin(system, motion, h, solver);
    }
}

/// Returns the kinds of coefficients that occur in the contacts of the world.
fn kinds_of(system: &System) -> ContactKinds {
    let is_some = |coefficient: Option<f64>| coefficient.is_some_and(|it| it > 0.0);
    let rolls = |it: Friction| is_some(it.rolling) || is_some(it.spinning);
    ContactKinds {
        friction: system.frictions().any(|it| it.acts()),
        rolling: system.frictions().any(rolls),
        laws: !system.spheres.restitution_law.is_empty()
            || system.material_pairs.list().iter().any(|it| it.restitution_law.is_some()),
        images: system.settings.boundary.is_periodic(),
        shear: system.settings.shear_rate != 0.0,
    }
}

/// Writes positions and velocities into the world, after a time of `h` \[s\].
pub(super) fn end(
    system: &System,
    motion: &mut Motion,
    h: f64,
    solver: &mut Solver,
    report: &mut StepReport,
) {
    wake::loaded(system, solver);
    sleep::fall_asleep(solver, h, report);
    report.contact_account.asleep = solver.asleep();
    solver.slots.write(motion);
    if solver.slots.turn.is_empty() {
        motion.spin.advance(h);
    }
    for (slot, turn) in solver.slots.turn.iter().enumerate() {
        let orientation = &mut motion.spin.orientation[solver.slots.index[slot] as usize];
        let radius = solver.slots.position[slot].number();
        *orientation = rotation::turned(*orientation, turn.vector() / radius, solver.h);
    }
    let contacts = solver.slabs.iter().map(|slab| slab.batches.count() + slab.surfaces.len());
    report.work.contacts += contacts.sum::<usize>() as u64;
    solver.slabs.iter_mut().for_each(|slab| slab.totals = SlabTotals::default());
}
