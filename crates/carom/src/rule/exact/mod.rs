//! The rule `exact`: spheres fly in closed form from event to event.
//!
//! 1. **Begin** (`frame`): forces without a closed form are held until the next force tick
//! 2. **Predict** (`predict`): what each sphere meets next, another sphere or a surface, and when it leaves
//!    its neighbour region
//! 3. **Queue** (`events`): the first event of all
//! 4. **Cell crossing** (`neighbours`): a sphere gets another neighbour region
//! 5. **Impact** (`impact`): an answer for all that touch there
//! 6. **Persistent contacts** (`persistent`): what stays closed, with its forces; then 2 again for the
//!    spheres at work
//! 7. **Emission**: spheres that are due within the frame are taken in (`frame`)
//! 8. **End of the frame** (`frame`): states are written, flights go on
//!
//! Predictions hold across frames. `docs/physics/exact.md` has the stages under the same names.

mod answer;
mod contacts;
mod context;
mod course;
mod displacement;
mod events;
mod features;
mod flights;
mod frame;
mod impact;
mod log;
mod moving_regions;
mod neighbours;
mod pair_times;
mod persistent;
mod predict;
mod span;
mod ticks;
mod timeline;
mod watch;
mod well_energy;
mod zones;

pub(crate) use answer::unfinished::Unfinished;
pub(crate) use course::{Course, follow};
pub(crate) use features::{NormalCurvature, curvature_of};
pub(crate) use flights::{
    Arrival, FlightLog, GroupImpact, HeldMotion, JointFlight, StruckTouch, SupportChange,
};
pub(crate) use frame::{
    Arrivals, HoldError, adopt, begin, deflect, end, persistent_contacts, restart, start,
    tick_for_springs, work_written,
};
pub(crate) use neighbours::MAX_SPHERES;
pub(crate) use span::Span;
pub(crate) use timeline::Timeline;
pub(crate) use watch::Watch;
pub(crate) use watch::look_along::{begin as begin_watch, end as end_watch};
pub(crate) use well_energy::well_energy;
pub(crate) use zones::zone::Zone;

use std::mem::take;

use context::StepContext;
use events::UpcomingEvent;
use pair_times::PairSearch;
use zones::frame_work::UNITS_PER_FLIGHT;

use crate::report::{StageCounts, StepReport};
use crate::system::System;
use crate::work::Work;

/// How far spheres are taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Until {
    /// Runs to the end of a span.
    End,
    /// Runs to the next impact, with all others at that instant, or to the end.
    NextImpact,
}

/// What comes first in a span.
enum Next {
    /// An event of the sphere at a slot.
    Event(u32, UpcomingEvent),
    /// A force tick \[s\], at which held forces are computed again.
    ForceTick(f64),
    /// A tick of the zones.
    ZoneTick,
    /// The time \[s\] at which radii outgrow the neighbour lists.
    Outgrown(f64),
}

/// Returns what comes first, if that is before the `end` of a span \[s\].
///
/// Zones are stepped under the forces of the next tick, so at the end of a frame both ticks wait for the next frame.
fn next(timeline: &mut Timeline, end: f64) -> Option<Next> {
    let (tick, force_tick) = (timeline.zone.next_tick(), timeline.next_force_tick());
    let outgrown = timeline.room_until();
    if let Some((slot, event)) = timeline.next(end.min(tick).min(force_tick).min(outgrown)) {
        Some(Next::Event(slot, event))
    } else if force_tick < end && force_tick <= tick {
        Some(Next::ForceTick(force_tick))
    } else if tick <= end && tick < force_tick {
        Some(Next::ZoneTick)
    } else {
        (outgrown < end).then_some(Next::Outgrown(outgrown))
    }
}

/// Advances all spheres over a span. Returns the time reached \[s\] (`docs/physics/exact.md`).
pub(crate) fn advance(
    system: &System,
    timeline: &mut Timeline,
    span: Span,
    work: &Work,
    report: &mut StepReport,
    until: Until,
) -> Result<f64, Unfinished> {
    let parameters = timeline.parameters.with_zone_tick(timeline.zone_tick());
    let mut context = StepContext::new(system, parameters, span, work, report);
    answer::check_forces(timeline, &context, span.start)?;
    let mut counts = SpanCounts::begin(timeline, work);
    let due = frame::arrange::ArrangementDue::of(timeline, system);
    let mut end = span.end;
    while let Some(next) = next(timeline, end) {
        let (is_event, is_outgrown) =
            (matches!(next, Next::Event(..)), matches!(next, Next::Outgrown(_)));
        let now = match next {
            Next::Event(slot, event) => answer::event(timeline, &mut context, slot, event)?,
            Next::ForceTick(time) => renew_forces(timeline, &mut context, time)?,
            Next::ZoneTick => {
                let now = zones::tick(timeline, &mut context);
                predict::restart_companions(timeline, &mut context, now);
                now
            }
            Next::Outgrown(time) => time,
        };
        if is_outgrown || is_event && due.is_now(timeline) {
            watch::look_along::follow(timeline, system);
            counts.count_from_zero(timeline);
            frame::rearrange(timeline, system, now);
        }
        if is_outgrown {
            // Images that slide, or radii that grow, may do so often between events.
            let flights = timeline.flights.bodies.len() as u64;
            context.renewed += flights;
            context.work.spend(UNITS_PER_FLIGHT * flights);
        }
        watch::look_along::follow(timeline, system);
        if work.is_stopped() {
            return Err(Unfinished::Stopped);
        }
        if until == Until::NextImpact && !context.report.impacts.is_empty() {
            end = now.min(end);
        }
    }
    counts.report(timeline, &mut context);
    Ok(end)
}

/// Computes the held forces at a force tick \[s\]. Returns its time \[s\].
fn renew_forces(
    timeline: &mut Timeline,
    context: &mut StepContext,
    now: f64,
) -> Result<f64, Unfinished> {
    let is_lost = |sphere| Unfinished::NonFiniteForce { sphere };
    let flights = frame::force_tick(timeline, context.system, now).map_err(is_lost)?;
    context.renewed += flights;
    if context.work.spend(UNITS_PER_FLIGHT * flights) { Ok(now) } else { Err(Unfinished::Stopped) }
}

/// Counts at the start of a span.
struct SpanCounts {
    events: u64,
    cell_crossings: u64,
    /// Work done, in units of [`Work`].
    units: u64,
}

impl SpanCounts {
    fn begin(timeline: &Timeline, work: &Work) -> Self {
        let Timeline { events, cell_crossings, .. } = *timeline;
        Self { events, cell_crossings, units: work.done() }
    }

    /// Continues the count where the timeline counts its events from zero again.
    fn count_from_zero(&mut self, timeline: &Timeline) {
        self.events = self.events.wrapping_sub(timeline.events);
        self.cell_crossings = self.cell_crossings.wrapping_sub(timeline.cell_crossings);
    }

    /// Writes the work of the stages since then, and the state of the zones, to the report.
    fn report(&self, timeline: &mut Timeline, context: &mut StepContext) {
        let events = timeline.events.wrapping_sub(self.events);
        let units = context.work.done() - self.units;
        let counts = StageCounts {
            events,
            cell_crossings: timeline.cell_crossings.wrapping_sub(self.cell_crossings),
            pair_tests: context.searches.iter().map(PairSearch::tests).sum(),
            solver_iterations: units - UNITS_PER_FLIGHT * (events + context.renewed),
            ..context.counts
        };
        context.report.work += take(&mut timeline.work.unreported);
        context.report.work += counts;
        context.report.zone_account.spheres = timeline.zone.len() as u32;
        context.report.contact_account.asleep = timeline.zone.asleep();
    }
}
