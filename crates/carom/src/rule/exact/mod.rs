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
mod corner;
mod flights;
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
use crate::bodies::SphereId;
use crate::report::StepReport;
use crate::system::System;

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

/// More happened in a frame than the parameters allow.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct TooManyImpacts {
    /// A sphere that was at work then.
    pub sphere: SphereId,
    /// The bound per sphere.
    pub limit: u32,
}

/// Advances all spheres to `end` \[s\] on the world's clock, in the step that began at `start`
/// (`docs/physics.md`, rule `exact`).
pub(crate) fn advance(
    system: &System,
    timeline: &mut Timeline,
    Span { start, length, end }: Span,
    report: &mut StepReport,
) -> Result<(), TooManyImpacts> {
    let Rule::Exact(parameters) = system.settings.rule else { return Ok(()) };
    let period = system.settings.boundary.period();
    let around = Default::default();
    let mut stage = Stage { system, parameters, report, start, length, period, around };
    while let Some((slot, next)) = timeline.next(system, end) {
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
        if timeline.flights_in_frame(slot) > parameters.max_impacts {
            let limit = parameters.max_impacts;
            return Err(TooManyImpacts { sphere: stage.id_of(timeline, slot), limit });
        }
    }
    Ok(())
}
