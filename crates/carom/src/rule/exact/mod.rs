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

mod budget;
mod clearance;
mod contact_scale;
mod contacts;
mod context;
mod course;
mod events;
mod flights;
mod force_work;
mod frame;
mod frame_work;
mod impact;
mod look_along;
mod neighbours;
mod pair_times;
mod persistent;
mod predict;
mod prefetch;
mod span;
mod stepped;
mod ticks;
mod timeline;
mod watch;
mod zone;

pub(crate) use contacts::{NormalCurvature, curvature_of};
pub(crate) use course::{Course, follow};
pub(crate) use frame::{
    Arrivals, HoldError, adopt, begin, end, persistent_contacts, start, tick_for_springs,
};
pub(crate) use look_along::{begin as begin_watch, end as end_watch};
pub(crate) use neighbours::MAX_SPHERES;
pub(crate) use span::Span;
pub(crate) use timeline::Timeline;
pub(crate) use watch::Watch;
pub(crate) use zone::Zone;

use std::mem::take;

use context::StepContext;
use events::{EventTarget, PackedTarget, UpcomingEvent};
use frame_work::UNITS_PER_FLIGHT;
use pair_times::PairSearch;
use persistent::held_forces;

use crate::id::SphereId;
use crate::report::{StageCounts, StepReport};
use crate::system::System;
use crate::work::Work;

/// Reason why a part of a frame was not completed.
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
    /// Friction acts in a way that has no closed form, and nothing is stepped.
    NoClosedForm {
        /// A sphere that it acts on.
        sphere: SphereId,
        /// When it happened, on the world's clock \[s\].
        time: f64,
    },
    /// Growth made a sphere so fast that it has no room left.
    NoRoomToGrow {
        /// The sphere.
        sphere: SphereId,
        /// When it happened, on the world's clock \[s\].
        time: f64,
    },
    /// A force on a sphere is not finite.
    NonFiniteForce {
        /// The sphere.
        sphere: SphereId,
    },
    /// A stop request came.
    Stopped,
}

/// The work allowed per sphere and frame is allowed in each part of a longer frame that has this many ticks.
const TICKS_OF_A_FRAME: f64 = 8.0;

/// How far spheres are taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Until {
    /// To the end of a span.
    End,
    /// To the next impact, with all others at that instant, or to the end.
    NextImpact,
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
    let mut before = WorkSoFar::of(timeline, work);
    let due = frame::ArrangementDue::of(timeline, system);
    let mut end = span.end;
    loop {
        let (tick, force_tick) = (timeline.zone.next_tick(), timeline.next_force_tick());
        let room_until = timeline.room_until();
        let now = match timeline.next(end.min(tick).min(force_tick).min(room_until)) {
            Some((slot, next)) => {
                let now = answer_event(timeline, &mut context, slot, next)?;
                if due.is_now(timeline) {
                    look_along::follow(timeline, system);
                    before.count_from_zero(timeline);
                    frame::rearrange(timeline, system, now);
                }
                now
            }
            // Zones are stepped under the forces of the next tick, so at the end of a frame both wait for the next
            // frame.
            None if force_tick < end && force_tick <= tick => {
                renew_forces(timeline, &mut context, force_tick)?
            }
            None if tick <= end && tick < force_tick => {
                let now = stepped::tick(timeline, &mut context);
                predict::restart_companions(timeline, &mut context, now);
                now
            }
            None if room_until < end => {
                look_along::follow(timeline, system);
                before.count_from_zero(timeline);
                frame::rearrange(timeline, system, room_until);
                room_until
            }
            None => break,
        };
        look_along::follow(timeline, system);
        if work.is_stopped() {
            return Err(Unfinished::Stopped);
        }
        if until == Until::NextImpact && !context.report.impacts.is_empty() {
            end = now.min(end);
        }
    }
    let counts = before.counts_since(timeline, &context);
    context.report.work += take(&mut timeline.work.unreported);
    context.report.work += counts;
    context.report.zone_account.spheres = timeline.zone.len() as u32;
    context.report.contact_account.asleep = timeline.zone.asleep();
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

/// Answers the next event of the sphere at `slot`. Returns its time \[s\].
fn answer_event(
    timeline: &mut Timeline,
    context: &mut StepContext,
    slot: u32,
    next: UpcomingEvent,
) -> Result<f64, Unfinished> {
    prefetch::upcoming_events(timeline, context.system);
    if !context.work.spend(UNITS_PER_FLIGHT) {
        return Err(Unfinished::Stopped);
    }
    let event = match next {
        UpcomingEvent::Event(event) => event,
        UpcomingEvent::CellCrossing(time) => {
            predict::cross_cell(timeline, context, slot, time);
            return Ok(time);
        }
    };
    if timeline.is_void(&event) {
        predict::fall_back(timeline, context, slot, event.time);
        return Ok(event.time);
    }
    if matches!(event.target.unpacked(), EventTarget::Sphere(_) | EventTarget::Surface(_)) {
        held_forces::prepare(timeline, context.system, event.time);
    }
    // Between impacts with a light one a heavy sphere hardly moves.
    let involved = [Some(slot), event.target.slot()];
    let has_moved = |slot: &u32| !timeline.is_unresolved(*slot, event.time);
    let is_counted = context.has_zones()
        && event.target != PackedTarget::STEP_END
        && !involved.iter().flatten().any(has_moved);
    match event.target.unpacked() {
        EventTarget::Restart => predict::restart(timeline, context, slot, event.time),
        EventTarget::StepEnd => predict::next_step(timeline, context, slot, event.time),
        EventTarget::Sphere(other) if timeline.flights.growth.is_some() => {
            impact::answer_growing_pair(timeline, context, [slot, other], event.time);
            check_room_to_grow(timeline, context, &[slot, other], event.time)?;
        }
        EventTarget::Surface(surface) if timeline.flights.growth.is_some() => {
            impact::answer_growing_single(timeline, context, slot, surface, event.time);
            check_room_to_grow(timeline, context, &[slot], event.time)?;
        }
        EventTarget::Sphere(other) => {
            impact::answer_pair(timeline, context, [slot, other], event.time);
        }
        EventTarget::Surface(surface) => {
            impact::answer_single(timeline, context, slot, Some(surface), event.time);
        }
        EventTarget::Cluster => {
            impact::answer_single(timeline, context, slot, None, event.time);
        }
    }
    predict::restart_companions(timeline, context, event.time);
    if let Some(index) = timeline.flights.lost {
        return Err(Unfinished::NonFiniteForce {
            sphere: context.system.spheres.id[index as usize],
        });
    }
    if let Some(slot) = context.unanswered {
        let sphere = context.id_of(timeline, slot);
        return Err(Unfinished::NoClosedForm { sphere, time: event.time });
    }
    check_work(timeline, context, slot, event.time)?;
    if is_counted {
        for slot in involved.into_iter().flatten() {
            count_short_flight(timeline, context, slot, event.time);
        }
    }
    Ok(event.time)
}

/// Returns an error if growth made a sphere so fast, at `time` \[s\], that it has no room left.
fn check_room_to_grow(
    timeline: &Timeline,
    context: &StepContext,
    slots: &[u32],
    time: f64,
) -> Result<(), Unfinished> {
    let overheated = slots.iter().find(|&&slot| timeline.flights.is_overheated(slot));
    overheated.map_or(Ok(()), |&slot| {
        let sphere = context.id_of(timeline, slot);
        Err(Unfinished::NoRoomToGrow { sphere, time })
    })
}

/// Counts a flight that ended before the sphere had moved. A sphere with too many of them joins a zone.
fn count_short_flight(timeline: &mut Timeline, context: &mut StepContext, slot: u32, time: f64) {
    let index = timeline.flights.index_of[slot as usize];
    let is_spent = timeline.budget.is_spent_by_flight(context.parameters, index, time);
    if is_spent && !timeline.flights.is_stepped(slot) {
        stepped::make_zone_about(timeline, context, slot, time);
    }
}

/// Work before a part of a frame.
struct WorkSoFar {
    events: u64,
    cell_crossings: u64,
    /// In units of [`Work`].
    units: u64,
}

impl WorkSoFar {
    fn of(timeline: &Timeline, work: &Work) -> Self {
        let Timeline { events, cell_crossings, .. } = *timeline;
        Self { events, cell_crossings, units: work.done() }
    }

    /// Continues the count where the timeline counts its events from zero again.
    fn count_from_zero(&mut self, timeline: &Timeline) {
        self.events = self.events.wrapping_sub(timeline.events);
        self.cell_crossings = self.cell_crossings.wrapping_sub(timeline.cell_crossings);
    }

    /// The work of the stages since then.
    fn counts_since(&self, timeline: &Timeline, context: &StepContext) -> StageCounts {
        let events = timeline.events.wrapping_sub(self.events);
        let units = context.work.done() - self.units;
        StageCounts {
            events,
            cell_crossings: timeline.cell_crossings.wrapping_sub(self.cell_crossings),
            pair_tests: context.searches.iter().map(PairSearch::tests).sum(),
            solver_iterations: units - UNITS_PER_FLIGHT * (events + context.renewed),
            ..context.counts
        }
    }
}

/// Puts a sphere that takes more work in a frame than the parameters allow into a zone, or returns
/// the error.
fn check_work(
    timeline: &mut Timeline,
    context: &mut StepContext,
    slot: u32,
    time: f64,
) -> Result<(), Unfinished> {
    let limit = context.parameters.max_impacts;
    let work = timeline.work_in_frame(slot);
    if work <= u64::from(limit) || timeline.flights.is_stepped(slot) {
        return Ok(());
    }
    if context.has_zones() {
        // A long frame may have as many in each of its parts.
        let parts = (time - context.start) / (TICKS_OF_A_FRAME * context.parameters.zone_tick);
        if work as f64 > f64::from(limit) * parts.ceil().max(1.0) {
            stepped::make_zone_about(timeline, context, slot, time);
        }
        return Ok(());
    }
    let sphere = context.id_of(timeline, slot);
    let companions = timeline.flights.companions(slot);
    Err(Unfinished::TooManyImpacts { sphere, limit, companions, time })
}
