//! Steps by the rule `exact`: flights continue from step to step, and spheres due within a step are emitted at
//! their own times.

use super::attempt::Attempt;
use super::place::{
    account_for_persistent_contacts, no_longer_finite, place_spheres, work_written,
};
use super::{shear, thermostat};
use crate::bodies::Spheres;
use crate::emitter;
use crate::error::{Error, InvalidValue, Subject};
use crate::forces;
use crate::id::SphereId;
use crate::report::StepReport;
use crate::rule::exact::{
    self, Arrival, Arrivals, HoldError, Span, Timeline, Unfinished, Until, Watch,
};
use crate::settings::Exact;
use crate::shear::Shear;
use crate::state::State;
use crate::sum::Sum;
use crate::system::System;
use crate::thermostat::Kicks;
use crate::validate;

/// Takes a step from event to event. If that fails, no sphere was moved.
pub(super) fn step(mut attempt: Attempt, parameters: Exact, until: Until) -> Result<(), Error> {
    let end = attempt.end.seconds();
    attempt.state.check_emitters(end)?;
    attempt.take(|attempt| {
        if until == Until::NextImpact {
            let (system, _) = attempt.state.split();
            check_closed_form(&system, "next event").map_err(|it| it.about(Subject::Step))?;
        }
        let mut timeline = begin(attempt, parameters, end)?;
        if attempt.scratch.flight_log.is_some() {
            timeline.begin_log(attempt.start);
        }
        let mut watch = watch_over(attempt);
        let end = advance(attempt, &mut timeline, &mut watch, end, until)?;
        attempt.end_at(end);
        if let Some(log) = &mut attempt.scratch.flight_log {
            *log = timeline.end_log();
        }
        account_for_contacts(attempt.report, &mut timeline, end);
        shear::account_for_impacts(attempt);
        place_spheres(attempt, &timeline, end)?;
        attempt.report.energy_account.colliders += work_written(attempt, &timeline, end);
        timeline.write_radii(&mut attempt.state.spheres.properties.radius, end);
        if !timeline.has_friction() {
            attempt.state.spheres.motion.spin.advance(attempt.length);
        }
        if let Some(watch) = &mut watch {
            attempt.report.energy_account.add_force_work(watch.take_work());
        }
        attempt.report_sensors(watch.and_then(|watch| watch.sensors));
        attempt.state.timeline = Some(timeline);
        let account = &mut attempt.report.zone_account;
        attempt.state.was_stepped |= account.joined > 0;
        account.sphere_seconds = f64::from(account.spheres) * attempt.length;
        Ok(())
    })?;
    attempt.report_triggers();
    Ok(())
}

/// Watch over spheres in a step; `None` without sensors, nonconservative forces and forces that may be held.
fn watch_over(attempt: &mut Attempt) -> Option<Watch> {
    let (start, presence) = (attempt.start, attempt.state.presence.clone());
    let (system, _) = attempt.state.split();
    let presence = (!system.trigger_tree.is_empty()).then_some(presence);
    let is_sheared = Shear::of(system.settings).is_some();
    let are_linear = forces::are_linear(system.forces) && !system.has_interactions();
    let may_hold = !are_linear && !system.holds_forces_of_all();
    let measures_work = system.has_nonconservative_forces() || is_sheared || may_hold;
    (presence.is_some() || measures_work).then(|| Watch::new(presence, measures_work, start))
}

/// Accounts for the impacts of a step, and for persistent contacts up to its end \[s\].
fn account_for_contacts(report: &mut StepReport, timeline: &mut Timeline, end: f64) {
    let taken = report.groups.iter().map(|group| group.energy_after - group.energy_before);
    report.energy_account.contacts += taken.collect::<Sum>().value();
    let given = report.groups.iter().map(|group| group.collider_work);
    report.energy_account.colliders += given.collect::<Sum>().value();
    let kicked = report.groups.iter().map(|group| group.kick_work);
    let kicked = kicked.collect::<Sum>().value();
    // Growth is refused beside colliders that kick.
    if timeline.has_growth() {
        report.energy_account.growth += kicked;
    } else {
        report.energy_account.kicks += kicked;
    }
    account_for_persistent_contacts(report, timeline, end);
}

/// The flights of all spheres at the start of the step, which ends at `end` \[s\]: flights of the step before
/// continue.
///
/// # Errors
/// [`Error::NonFiniteState`] if a force is not finite, [`Error::Invalid`] if a periodic box is too small
/// for the spheres, if there are too many of them, or if springs are too stiff.
fn begin(attempt: &mut Attempt, parameters: Exact, end: f64) -> Result<Timeline, Error> {
    let (state, time) = (&mut *attempt.state, attempt.start);
    check_room(state)?;
    let (before, zone) = (state.timeline.take(), std::mem::take(&mut state.zone));
    let next_emission = emitter::next_due(&state.emitters);
    let (system, motion) = state.split();
    if let Some(before) = &before {
        let written = exact::work_written(before, &system, motion, time);
        attempt.report.energy_account.colliders -= written;
    }
    let mut timeline =
        before.unwrap_or_else(|| exact::start(&system, parameters, motion, zone, time));
    exact::begin(&mut timeline, &system, [time, end], next_emission)
        .map_err(|error| refused_forces(error, time))?;
    Ok(timeline)
}

/// Returns an error if forces have no closed form, since `what` needs one.
///
/// # Errors
/// The field that it is.
pub(super) fn check_closed_form(system: &System, what: &'static str) -> Result<(), InvalidValue> {
    let varies = system.has_interactions() || !forces::are_linear(system.forces);
    let requirement = "such that motion under all forces is known in closed form until then";
    let forces = "one of springs, or of forces that depend on places";
    validate::require(!varies, what, requirement, forces)
}

/// Advances flights and emissions to `end` \[s\], or to the next impact. Returns the time reached \[s\].
fn advance(
    attempt: &mut Attempt,
    timeline: &mut Timeline,
    watch: &mut Option<Watch>,
    end: f64,
    until: Until,
) -> Result<f64, Error> {
    let (start, length) = (attempt.start, attempt.length);
    emit(attempt, timeline, start)?;
    let mut kicks = thermostat::kicks_after(attempt.state, start);
    let mut now = start;
    loop {
        let due = emitter::next_due(&attempt.state.emitters);
        let kick = kicks.as_ref().map_or(f64::INFINITY, Kicks::next);
        let span = Span { start, length, end: due.min(kick).min(end) };
        let Attempt { state, work, report, .. } = &mut *attempt;
        let (system, _) = state.split();
        if let Some(watch) = watch.take() {
            exact::begin_watch(timeline, &system, watch, now);
        }
        let came_to = exact::advance(&system, timeline, span, work, report, until)
            .map_err(|unfinished| refusal(unfinished, start))?;
        *watch = exact::end_watch(timeline, &system, came_to);
        now = span.end;
        let is_over = until == Until::NextImpact && !attempt.report.impacts.is_empty();
        if is_over {
            return Ok(came_to);
        }
        if let Some(kicks) = kicks.as_mut().filter(|kicks| kicks.next() <= now) {
            thermostat::kick_spheres(attempt, timeline, kicks)?;
        }
        if now >= end {
            return Ok(came_to);
        }
        if due <= now {
            emit(attempt, timeline, due)?;
            kicks = thermostat::kicks_after(attempt.state, now);
        }
    }
}

/// Emits the spheres that are due at `time` \[s\]; the others fly on.
///
/// # Errors
/// [`Error::NonFiniteState`] if a sphere is nowhere.
fn emit(attempt: &mut Attempt, timeline: &mut Timeline, time: f64) -> Result<(), Error> {
    if !emitter::any_due(&attempt.state.emitters, time) {
        return Ok(());
    }
    // The present spheres may be in the way, and their energy counts.
    attempt.expect_emission();
    place_spheres(attempt, timeline, time)?;
    account_for_persistent_contacts(attempt.report, timeline, time);
    let known = attempt.state.spheres.ids().to_vec();
    let emission = attempt.emit(time);
    let next = emitter::next_due(&attempt.state.emitters);
    let time_of = |id| match emission.emitted.binary_search(&id) {
        Ok(place) => emission.due[place],
        Err(_) => time,
    };
    let arrivals = Arrivals { known: &known, time_of, next };
    let log = timeline.end_log();
    let (system, motion) = attempt.state.split();
    *timeline = exact::adopt(timeline, &system, motion, arrivals, time);
    if attempt.scratch.flight_log.is_some() {
        let arrivals = emission.emitted.iter().zip(&emission.due);
        let arrivals =
            arrivals.filter_map(|(&id, &time)| arrival(&attempt.state.spheres, id, time));
        timeline.resume_log(log, arrivals.collect(), time);
    }
    Ok(())
}

/// Returns a sphere that begins at `time` \[s\], for a log of flights.
fn arrival(spheres: &Spheres, id: SphereId, time: f64) -> Option<Arrival> {
    let index = spheres.index_of(id)?;
    let [positions, velocities] = [spheres.positions(), spheres.velocities()];
    let spin = spheres.angular_velocities().get(index).copied();
    let angular_velocity = spin.unwrap_or_default();
    let (position, velocity) = (positions[index], velocities[index]);
    Some(Arrival { id, time, position, velocity, angular_velocity })
}

/// Returns the error of a step that starts at `time` \[s\] and was not taken to its end.
fn refusal(unfinished: Unfinished, time: f64) -> Error {
    match unfinished {
        Unfinished::Stopped => Error::Stopped { time },
        Unfinished::NonFiniteForce { sphere } => no_longer_finite(sphere, "velocity", time),
        Unfinished::NoClosedForm { sphere, time: at } => Error::NeedsZone { sphere, at, time },
        Unfinished::NoRoomToGrow { sphere, time: at } => Error::NoRoomToGrow { sphere, at, time },
        Unfinished::RestsInPotential { sphere, time: at } => {
            Error::RestsInPotential { sphere, at, time }
        }
        Unfinished::TooManyImpacts { sphere, limit, companions, time: at } => {
            Error::TooManyImpacts { sphere, limit, companions, at, time }
        }
    }
}

/// Returns the errors of a step of this length \[s\] that do not depend on forces.
///
/// # Errors
/// [`Error::Invalid`] if a periodic box is too small for the spheres, if there are too many of them, or if springs
/// are too stiff.
pub(super) fn check(state: &State, parameters: Exact, length: f64) -> Result<(), Error> {
    check_room(state)?;
    let now = state.now();
    let tick = exact::tick_for_springs(now.system.fastest_spring_rate(), parameters, length);
    tick.map(drop).map_err(|error| refused_forces(error, now.time))
}

/// Returns an error for spheres without room.
pub(super) fn check_room(state: &State) -> Result<(), Error> {
    check_count(state)?;
    state.check_box()
}

/// Returns an error for more spheres than the rule `exact` can distinguish.
fn check_count(state: &State) -> Result<(), Error> {
    let (count, most) = (state.spheres.ids().len(), exact::MAX_SPHERES);
    let requirement = "few enough for the rule exact: at most 2^27 spheres";
    validate::require(count <= most, "spheres", requirement, count as f64)
        .map_err(|invalid| invalid.about(Subject::Step))
}

/// Returns the error of a step in which forces cannot be held, and that starts at `time` \[s\].
pub(super) fn refused_forces(error: HoldError, time: f64) -> Error {
    match error {
        HoldError::NotFinite(sphere) => no_longer_finite(sphere, "velocity", time),
        HoldError::TooStiff(rate) => InvalidValue {
            field: "stiffness",
            requirement: "small enough for the `force_tick` and the `zone_tick` of the rule exact",
            value: format!("so large that ticks must be shorter than {:.3e} s", 2048.0 / rate),
        }
        .about(Subject::Step),
    }
}
