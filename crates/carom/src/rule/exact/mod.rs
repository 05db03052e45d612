//! The rule `exact`: spheres fly in closed form from event to event.
//!
//! 1. **predict** what each sphere comes upon next: another sphere, a surface, the end of its neighbourhood
//! 2. take the first event from the **queue**
//! 3. **impact**: answer it, with all that touch there, and predict anew what changed
//!
//! until the frame ends. What was predicted stays good from frame to frame.

mod alone;
mod axis_motion;
mod body;
mod bounce;
mod carry;
mod cells;
mod cluster;
mod contact_duration;
mod corner;
mod flights;
mod follow_up;
mod grid;
mod group;
mod hold;
mod impact;
mod lists;
mod near_surfaces;
mod neighbour;
mod neighbours;
mod outlook;
mod periodic;
mod predict;
mod queue;
mod room;
mod settle;
mod sight;
mod stage;
mod support;
mod surroundings;
mod timeline;
mod touch;
mod vicinity;

pub(crate) use neighbour::MAX_SPHERES;
use outlook::{Next, Upon};
use stage::Stage;
pub(crate) use timeline::Timeline;

use super::Rule;
use crate::bodies::{Motion, SphereId};
use crate::report::StepReport;
use crate::system::System;
use crate::work::Work;

/// A step, or its part up to some time, on the world's clock \[s\].
#[derive(Debug, Clone, Copy)]
pub(crate) struct Span {
    /// Beginning of the step.
    pub start: f64,
    /// Length of the step \[s\].
    pub length: f64,
    /// End of the part.
    pub end: f64,
}

/// Units of work that count as much as one flight of a sphere.
const UNITS_PER_FLIGHT: u64 = 32;

/// Why a part of a frame was not taken to its end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Unfinished {
    /// A sphere took more work than the parameters allow.
    TooManyImpacts {
        /// A sphere that was at work then.
        sphere: SphereId,
        /// The bound per sphere.
        limit: u32,
        /// How many spheres it was in persistent contact with, directly or through others.
        companions: usize,
        /// When it happened, on the world's clock \[s\].
        time: f64,
    },
    /// It was asked to stop.
    Stopped,
}

/// Writes where all spheres are at the end of a part of a step, and how they move there.
pub(crate) fn write_motion(
    system: &System,
    timeline: &Timeline,
    motion: &mut Motion,
    Span { start, length, end }: Span,
) {
    let period = system.settings.boundary.period();
    timeline.write_motion(motion, period, end);
    let Rule::Exact(parameters) = system.settings.rule else { return };
    let (around, report) = (Default::default(), &mut StepReport::default());
    let work = &Work::unlimited();
    let stage = Stage { system, parameters, report, work, start, length, period, around };
    settle::write_motion(timeline, &stage, motion, end);
}

/// Advances all spheres to `end` \[s\] on the world's clock, in the step that began at `start`
/// (`docs/physics.md`, rule `exact`).
pub(crate) fn advance(
    system: &System,
    timeline: &mut Timeline,
    Span { start, length, end }: Span,
    work: &Work,
    report: &mut StepReport,
) -> Result<(), Unfinished> {
    let Rule::Exact(parameters) = system.settings.rule else { return Ok(()) };
    let period = system.settings.boundary.period();
    let around = Default::default();
    let mut stage = Stage { system, parameters, report, work, start, length, period, around };
    while let Some((slot, next)) = timeline.next(system, end) {
        if !work.spend(UNITS_PER_FLIGHT) {
            return Err(Unfinished::Stopped);
        }
        let event = match next {
            Next::Event(event) => event,
            Next::Departure(time) => {
                predict::relocate(timeline, &mut stage, slot, time);
                continue;
            }
        };
        match event.target.upon() {
            Upon::Restart => predict::restart(timeline, &mut stage, slot, event.time),
            Upon::Sphere(_) if timeline.is_void(&event) => {
                predict::fall_back(timeline, &mut stage, slot, event.time);
            }
            Upon::Sphere(other) => {
                impact::of_spheres(timeline, &mut stage, [slot, other], event.time);
            }
            Upon::Surface(surface) => {
                bounce::answer(timeline, &mut stage, slot, Some(surface), event.time);
            }
            Upon::Cluster => bounce::answer(timeline, &mut stage, slot, None, event.time),
        }
        if work.is_stopped() {
            return Err(Unfinished::Stopped);
        }
        if timeline.work_in_frame(slot) > u64::from(parameters.max_impacts) {
            return Err(Unfinished::TooManyImpacts {
                sphere: stage.id_of(timeline, slot),
                limit: parameters.max_impacts,
                companions: timeline.companions(slot),
                time: event.time,
            });
        }
    }
    Ok(())
}
