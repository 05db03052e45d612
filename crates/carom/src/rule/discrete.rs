//! The rule `discrete`: move, then answer what overlaps at the end of the frame.

use glam::DVec3;

use crate::bodies::Motion;
use crate::detect::contact::{Bodies, Contact};
use crate::detect::contacts::{self, Search};
use crate::detect::instant::{Instant, reach};
use crate::detect::passage::FrameStart;
use crate::detect::{ContactState, sphere_surface};
use crate::integrate;
use crate::interval::Interval;
use crate::report::{StepReport, TriggerContact};
use crate::respond;
use crate::settings::Discrete;
use crate::surface::{Form, Role};
use crate::system::System;

/// Surfaces are looked for this part of the radius beyond a sphere: farther than it is put out of
/// most of them, so that it seldom has to look again.
const ROOM: f64 = 1.0 / 16.0;

/// Working memory of the rule, kept from step to step only to spare its allocation.
#[derive(Debug, Clone, Default)]
pub(crate) struct Scratch {
    integrate: integrate::Scratch,
    near: Vec<u32>,
    /// Centres at the start of the frame \[m\].
    start: Vec<DVec3>,
    search: Search,
    contacts: Vec<Contact>,
}

/// Advances all spheres by one frame (`docs/physics/bisect-and-discrete.md`).
pub(crate) fn step(
    system: &System,
    parameters: Discrete,
    motion: &mut Motion,
    frame: Interval,
    scratch: &mut Scratch,
    report: &mut StepReport,
) {
    let everyone = 0..system.spheres.id.len() as u32;
    let Discrete { integrator, .. } = parameters;
    scratch.start.clone_from(&motion.position);
    let work = integrate::work(integrator, system, motion, everyone.clone(), frame);
    report.energy_account.add_force_work(work);
    integrate::advance(integrator, system, motion, everyone.clone(), frame, &mut scratch.integrate);
    let frame_start = Some(FrameStart { centers: &scratch.start });
    let from_start = System { frame_start, ..*system };
    for sphere in everyone {
        meet_surfaces(&from_start, motion, sphere, frame, &mut scratch.near, report);
    }
    meet_each_other(system, motion, frame, scratch, report);
}

/// Answers the surfaces that a sphere overlaps, in scene order; each acts on what the ones before
/// it made of the sphere.
fn meet_surfaces(
    system: &System,
    motion: &mut Motion,
    sphere: u32,
    frame: Interval,
    near: &mut Vec<u32>,
    report: &mut StepReport,
) {
    let place = |motion: &Motion| motion.position[sphere as usize];
    let room = ROOM * system.spheres.radius[sphere as usize];
    let find_near = |motion: &Motion, near: &mut Vec<u32>| {
        system.tree.near(&reach(system, motion, sphere as usize, room), near);
        place(motion)
    };
    let mut found_at = find_near(motion, near);
    let mut next = 0;
    while let Some(&surface) = near.get(next) {
        next += 1;
        if system.surfaces[surface as usize].role == Role::Encloses {
            continue;
        }
        let Some(contact) = overlap(system, motion, sphere, surface) else { continue };
        if system.surfaces[surface as usize].role == Role::Reports {
            report.triggers.extend(TriggerContact::of(&contact, system));
            continue;
        }
        let Some(impact) = respond::answer(&contact, system, motion, frame.h) else { continue };
        report.impacts.push(impact);
        let lift = respond::put_on_surface(&contact, system, motion, frame.time + frame.h);
        report.energy_account.correction += lift.unwrap_or(0.0);
        if lift.is_some() && (place(motion) - found_at).abs().max_element() >= room {
            // The sphere moved far: other surfaces may be near now. Go on with those that follow.
            found_at = find_near(motion, near);
            next = near.partition_point(|&other| other <= surface);
        }
    }
}

/// The contact of a sphere with a surface, if they meet by this rule: with a rounded surface they
/// must overlap, with a flat one touching is enough.
fn overlap(system: &System, motion: &Motion, sphere: u32, surface: u32) -> Option<Contact> {
    let i = sphere as usize;
    let form = &system.surfaces[surface as usize].form;
    let separation = sphere_surface(form, motion.position[i], system.spheres.radius[i])?;
    let meets = match form {
        Form::Sphere { .. } | Form::Edge(_) | Form::Corner(_) => separation.distance < 0.0,
        _ => separation.distance <= 0.0,
    };
    let bodies = Bodies::Surface { sphere, surface };
    (meets && system.meets_surface(sphere, surface)).then_some(Contact {
        bodies,
        separation,
        state: ContactState::Intersecting,
    })
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
    contacts::find_overlapping_pairs(&end, 0.0, search, contacts);
    report.work.pair_tests += search.take_pair_tests();
    report.impacts.extend(respond::sequentially(contacts.iter(), system, motion, frame.h));
}
