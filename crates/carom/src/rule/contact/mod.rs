//! The rule `contact`: sub-steps, in each of which the contacts of all spheres are solved together
//! (`docs/physics/contact.md`).
//!
//! A frame is cut into sub-steps of equal length, more where forces or turning surfaces do much in one. Each goes
//! through these stages:
//!
//! 1. **Wake.** Spheres that something is about to hit wake.
//! 2. **Accelerate.** Forces change velocities.
//! 3. **Search.** Where a sphere may leave the margin of the last search, neighbours are found again.
//! 4. **Prepare.** Normals, gaps and impacts; contacts begin with the impulses of the sub-step before.
//! 5. **Sweep.** Each contact in turn gets the impulse that it needs, by Gauss and Seidel; contacts of spheres with very
//!    different masses in blocks.
//! 6. **Follow cascades.** Islands of spheres go from impact to impact.
//! 7. **Keep energy.** Where impulses would add kinetic energy elsewhere, less of them is taken.
//! 8. **Advance.** Positions follow the velocities.
//! 9. **Correct.** Overlaps are reduced, without a change of velocities.
//! 10. **Hold.** Where a centre would still pass a surface, it is held back.

mod accelerate;
mod advance;
mod blocks;
mod bounces;
mod cascade;
mod contacts;
mod energy;
mod frame;
mod guard;
mod neighbours;
mod places;
mod proximity;
mod report;
mod resolution;
mod shearing;
mod slabs;
mod sleep;
mod slots;
mod solve;
mod solver;
mod sub_step;

pub(crate) use guard::{Passage, held};
pub(crate) use places::turning_rate;
pub(crate) use proximity::{Proximity, bearing, conservative_forces, proximity};
pub(crate) use report::listing::{passages, persistent_contacts};
pub(crate) use resolution::{TURN, longest_frame_for_springs};
pub(crate) use solver::{Scratch, Solver};

use glam::DVec3;

use self::report::{force_work, impacts, virial};
use self::shearing::Shearing;
use self::sleep::wake;

use crate::bodies::Motion;
use crate::interval::Interval;
use crate::report::StepReport;
use crate::sensor::Tracks;
use crate::settings::Contact;
use crate::system::System;
use crate::work::{StopRequest, Work};

/// Work of a sub-step, for each sphere.
const UNITS_PER_SPHERE: u64 = 16;

/// A frame of `h` \[s\] in which all spheres sleep; a sphere that spins in its place keeps spinning.
pub(crate) fn rest(solver: &Solver, motion: &mut Motion, h: f64, report: &mut StepReport) {
    report.contact_account.asleep = solver.asleep();
    if motion.spin.angular_velocity.iter().any(|&it| it != DVec3::ZERO) {
        motion.spin.advance(h);
    }
}

/// Memory of the rule that a frame writes.
pub(crate) struct Memory<'a> {
    /// Order of the spheres, their neighbours and impulses.
    pub solver: &'a mut Solver,
    /// Rebuilt in each frame.
    pub scratch: &'a mut Scratch,
    /// Where spheres are after each sub-step, for sensors.
    pub tracks: &'a mut Tracks,
}

/// Advances all spheres by one frame. Returns whether the frame was completed; a request may stop it.
pub(crate) fn step(
    system: &System,
    parameters: Contact,
    motion: &mut Motion,
    frame: Interval,
    memory: Memory,
    report: &mut StepReport,
    stop_request: Option<&StopRequest>,
) -> bool {
    let Memory { solver, scratch, tracks } = memory;
    let work = Work::new(stop_request);
    solver.sleep_speed = parameters.sleep_speed;
    frame::begin(system, motion, frame.h, solver);
    let spring_rate = system.fastest_spring_rate();
    let sub_steps = resolution::sub_steps(solver, parameters.sub_steps, frame.h, spring_rate);
    let parameters = parameters.with_sub_steps(sub_steps);
    for number in 0..sub_steps {
        if !work.spend(UNITS_PER_SPHERE * solver.slots.len() as u64) {
            return false;
        }
        sub_step(system, parameters, (frame, number), (solver, scratch), report);
        tracks.note(|| solver.slots.positions());
    }
    solver.slots.time = frame.time + frame.h;
    frame::end(system, motion, frame.h, solver, report);
    true
}

/// Advances all spheres by one sub-step, the first one of a frame, for a rule that reads them after each and
/// changes only which spheres there are.
pub(crate) fn tick(
    system: &System,
    parameters: Contact,
    motion: &mut Motion,
    frame: Interval,
    (solver, scratch): (&mut Solver, &mut Scratch),
    report: &mut StepReport,
) {
    solver.sleep_speed = parameters.sleep_speed;
    frame::go_on(system, motion, frame.h, solver);
    sub_step(system, parameters, (frame, 0), (solver, scratch), report);
    frame::end(system, motion, solver.h, solver, report);
}

/// Advances all spheres by a sub-step of a frame, by its number.
fn sub_step(
    system: &System,
    parameters: Contact,
    (frame, number): (Interval, u32),
    (solver, scratch): (&mut Solver, &mut Scratch),
    report: &mut StepReport,
) {
    let h = frame.h / f64::from(parameters.sub_steps);
    wake::touched(system, solver, h);
    let start = f64::from(number) * h;
    solver.slots.time = frame.time + start;
    let shearing = Shearing::begin(solver, report);
    solver.places.begin_sub_step(system, [start, start + h]);
    let sub_step = accelerate::accelerate(system, frame.time, h, number, solver);
    if solver.is_stale {
        neighbours::search(system, frame, &sub_step, solver, scratch, report);
    }
    force_work::find(system, solver, frame.time + start + 0.5 * h);
    solve::prepare(solver, &sub_step);
    solve::sweep(solver, &sub_step, parameters, report);
    blocks::solve(solver, &sub_step);
    let first = report.impacts.len();
    let mut bounces = bounces::find(solver, &sub_step);
    let seeds = bounces::entangled(solver, &bounces, &sub_step);
    cascade::follow(system, solver, &seeds, &sub_step, report);
    if energy::keep(solver, &sub_step, report) {
        bounces = bounces::find(solver, &sub_step);
    }
    cascade::land(solver);
    impacts::report(system, solver, &sub_step, first, report);
    virial::account(solver, report);
    bounces::note(solver, bounces, &sub_step);
    force_work::account(solver, &sub_step, report);
    advance::advance(solver, &sub_step, report);
    let shearing = shearing.map(|it| it.account(solver, report));
    solve::correct(solver, report);
    if let Some(shearing) = shearing {
        shearing.account_for_correction(solver, report);
    }
    guard::hold(system, solver, &sub_step, report);
    solver.places.end_sub_step();
}
