//! A step of a world: spheres that are due are emitted, the rule moves all spheres, and a failed step leaves the
//! world as it was.

mod attempt;
mod by_event;
mod by_frame;
mod capture;
mod growth;
mod lookahead;
mod non_additivity;
mod obstacle;
mod pair_potential;
mod place;
mod plane;
mod shear;
mod singular;
mod sweep;
mod thermostat;

pub(crate) use attempt::Scratch;
pub(crate) use lookahead::predict;

use attempt::Attempt;

use crate::error::{Error, Subject};
use crate::parallel;
use crate::report::StepReport;
pub(crate) use crate::rule::exact::Until;
use crate::rule::{bisect, contact, discrete};
use crate::settings::Rule;
use crate::state::State;
use crate::validate;
use crate::work::{StopRequest, Work};

/// Checks `dt` \[s\] and the state; returns the error that a step would return, whatever forces act.
///
/// # Errors
/// [`Error::Invalid`]
pub(crate) fn check(state: &State, dt: f64) -> Result<(), Error> {
    check_length(state, dt)?;
    check_combinations(state, dt)?;
    state.check_emitters(state.clock.after(dt).seconds())?;
    match state.settings.rule {
        Rule::Exact(parameters) => by_event::check(state, parameters, dt),
        Rule::Contact(_) => state.check_box().and_then(|()| state.check_springs(dt)),
        Rule::Discrete(_) | Rule::Bisect(_) => state.check_springs(dt),
    }
}

/// Returns an error for a length \[s\] that no step can have.
fn check_length(state: &State, dt: f64) -> Result<(), Error> {
    let end = state.clock.after(dt).seconds();
    let requirement = "so short that the time stays finite";
    validate::positive("dt", dt)
        .and_then(|()| validate::require(end.is_finite(), "dt", requirement, dt))
        .map_err(|invalid| invalid.about(Subject::Step))
}

/// Returns an error for what two dimensions, shear, growth, a pair potential, pairs of materials, forces or the
/// thermostat cannot be combined with in a step of `dt` \[s\].
fn check_combinations(state: &State, dt: f64) -> Result<(), Error> {
    plane::check(state)?;
    shear::check(state, dt)?;
    growth::check(state, dt)?;
    pair_potential::check(state)?;
    singular::check(state)?;
    non_additivity::check(state)?;
    let Some(thermostat) = state.settings.thermostat else { return Ok(()) };
    let end = state.clock.after(dt).seconds();
    thermostat.check_step(dt, end).map_err(|invalid| invalid.about(Subject::Step))
}

/// Advances a world by `dt` \[s\], or until something happens in it, by the rule of its settings, and
/// writes the report.
///
/// # Errors Those of [`World::step`](crate::World::step). The world then keeps the state before the step.
pub(crate) fn step(
    state: &mut State,
    dt: f64,
    stop_request: Option<&StopRequest>,
    scratch: &mut Scratch,
    report: &mut StepReport,
    until: Until,
) -> Result<(), Error> {
    check_length(state, dt)?;
    check_combinations(state, dt)?;
    report.clear();
    if stop_request.is_some_and(StopRequest::is_made) {
        return Err(Error::Stopped { time: state.clock.seconds() });
    }
    let work = Work::new(stop_request);
    let rule = state.settings.rule;
    let knows_events = until == Until::End || matches!(rule, Rule::Exact(_));
    let requirement = "`exact` to step to an event";
    validate::require(knows_events, "rule", requirement, "one that steps frames")
        .map_err(|invalid| invalid.about(Subject::Settings))?;
    advance(Attempt::new(state, scratch, report, work, dt), stop_request, until)?;
    capture::capture(state, report);
    Ok(())
}

/// Moves all spheres by the rule of the settings.
fn advance(
    mut attempt: Attempt,
    stop_request: Option<&StopRequest>,
    until: Until,
) -> Result<(), Error> {
    match attempt.state.settings.rule {
        Rule::Discrete(parameters) => {
            by_frame::step(&mut attempt, |state, frame, scratch, report| {
                let (system, motion) = state.split();
                let scratch = &mut scratch.discrete;
                discrete::step(&system, parameters, motion, frame, scratch, report);
                motion.spin.advance(frame.h);
                by_frame::account_for_impacts(state, report);
                true
            })?;
            attempt.report_moved_triggers();
            Ok(())
        }
        Rule::Bisect(parameters) => {
            by_frame::step(&mut attempt, |state, frame, scratch, report| {
                let (system, motion) = state.split();
                let scratch = &mut scratch.bisect;
                let is_done =
                    bisect::step(&system, parameters, motion, frame, scratch, report, stop_request);
                motion.spin.advance(frame.h);
                by_frame::account_for_impacts(state, report);
                is_done
            })?;
            attempt.report_moved_triggers();
            Ok(())
        }
        Rule::Exact(parameters) => by_event::step(attempt, parameters, until),
        Rule::Contact(_) if attempt.state.is_idle(attempt.start, attempt.length) => {
            let (_, motion, solver) = attempt.state.split_with_solver();
            contact::rest(solver, motion, attempt.length, attempt.report);
            attempt.begin_tracks();
            attempt.take(|attempt| {
                sweep::report(attempt);
                Ok(())
            })?;
            attempt.report_triggers();
            Ok(())
        }
        Rule::Contact(parameters) => {
            attempt.state.check_box()?;
            by_frame::step(&mut attempt, |state, frame, scratch, report| {
                let (system, motion, solver) = state.split_with_solver();
                let (scratch, tracks) = (&mut scratch.contact, &mut scratch.tracks);
                let memory = contact::Memory { solver, scratch, tracks };
                parallel::among_threads(system.spheres.id.len(), || {
                    contact::step(&system, parameters, motion, frame, memory, report, stop_request)
                })
            })?;
            attempt.report_triggers();
            Ok(())
        }
    }
}
