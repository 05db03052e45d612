//! The rule `discrete`: move, then answer what overlaps at the end of the frame.

use glam::DVec3;

use super::Scratch;
use crate::bodies::Motion;
use crate::detect::contacts::{self, Bodies, Contact, Instant};
use crate::detect::{ContactState, Separation, sphere_surface};
use crate::integrate;
use crate::report::{StepReport, TriggerContact};
use crate::respond;
use crate::surface::{Form, Role};
use crate::system::{Interval, System};

/// Advances all spheres by one frame (`docs/physics.md`, rule `discrete`).
pub(super) fn step(
    system: &System,
    motion: &mut Motion,
    frame: Interval,
    scratch: &mut Scratch,
    report: &mut StepReport,
) {
    for index in 0..system.spheres.id.len() {
        let (position, velocity) = integrate::advance(system, motion, index, frame);
        motion.position[index] = position;
        motion.velocity[index] = velocity;
        meet_surfaces(system, motion, (index, frame.h), &mut scratch.near, report);
    }
    meet_each_other(system, motion, frame, scratch, report);
}

/// Answers the surfaces that a sphere overlaps, in scene order; each sees what the ones before
/// it made of the sphere.
fn meet_surfaces(
    system: &System,
    motion: &mut Motion,
    (index, time): (usize, f64),
    near: &mut Vec<u32>,
    report: &mut StepReport,
) {
    let find_near = |motion: &Motion, near: &mut Vec<u32>| {
        system.tree.near(&contacts::reach(system, motion, index, 0.0), near);
    };
    find_near(motion, near);
    let mut next = 0;
    while let Some(&number) = near.get(next) {
        next += 1;
        let surface = &system.surfaces[number as usize];
        let (center, radius) = (motion.position[index], system.spheres.radius[index]);
        let Some(separation) = sphere_surface(&surface.form, center, radius) else { continue };
        if !is_contact(&surface.form, &separation) {
            continue;
        }
        let bodies = Bodies::Surface { sphere: index as u32, surface: number };
        let contact = Contact { bodies, separation, state: ContactState::Intersecting };
        match surface.role {
            Role::Deflects => {}
            Role::Reports => {
                report.triggers.extend(TriggerContact::of(&contact, system));
                continue;
            }
            Role::Encloses => continue,
        }
        let Some(impact) = respond::answer(&contact, system, motion, time) else { continue };
        report.impacts.push(impact);
        if put_on_surface((&surface.form, &separation), radius, &mut motion.position[index]) {
            // The sphere moved: other surfaces may be near now. Go on with those that follow.
            find_near(motion, near);
            next = near.partition_point(|&other| other <= number);
        }
    }
}

/// Contact with a rounded surface needs overlap; with a flat one, touching is enough.
fn is_contact(form: &Form, separation: &Separation) -> bool {
    match form {
        Form::Sphere { .. } => separation.distance < 0.0,
        Form::Rectangle(_) | Form::HalfSpace { .. } | Form::Box(_) => separation.distance <= 0.0,
    }
}

/// Puts a sphere that hit a flat surface onto it, in place of the normal force that would keep
/// it there; on rounded surfaces it is left where it is. Tells whether it was moved.
pub(super) fn put_on_surface(
    (form, separation): (&Form, &Separation),
    radius: f64,
    position: &mut DVec3,
) -> bool {
    let is_flat = !matches!(form, Form::Sphere { .. });
    if is_flat {
        *position = separation.point + radius * separation.normal;
    }
    is_flat
}

/// Answers the pairs that overlap at the end of the frame, in order of their ids.
fn meet_each_other(
    system: &System,
    motion: &mut Motion,
    frame: Interval,
    scratch: &mut Scratch,
    report: &mut StepReport,
) {
    let Scratch { search, contacts, .. } = scratch;
    let end = Instant { system: *system, motion, time: frame.time + frame.h };
    contacts::of_overlapping_pairs(&end, 0.0, search, contacts);
    respond::sequentially(contacts.iter(), system, motion, (frame.h, &mut report.impacts));
}
