//! Looking ahead: the path of one sphere, without a step.

use super::{by_event, growth};
use crate::error::{Error, Subject};
use crate::path::PredictedPath;
use crate::rule::exact::{self, Span};
use crate::settings::{Exact, Rule, Settings};
use crate::state::State;
use crate::validate;
use crate::work::{StopRequest, Work};

/// Predicts the path of the sphere at an index of the arrays over `horizon` \[s\], or up to a number of
/// impacts.
///
/// # Errors
/// Those of [`World::predict`](crate::World::predict).
pub(crate) fn predict(
    state: &State,
    index: usize,
    horizon: f64,
    most_impacts: usize,
    stop_request: Option<&StopRequest>,
) -> Result<PredictedPath, Error> {
    let now = state.now();
    let end = now.time + horizon;
    validate::positive("horizon", horizon)
        .and_then(|()| validate::finite_number("horizon", end))
        .map_err(|invalid| invalid.about(Subject::Query))?;
    by_event::check_room(state)?;
    growth::check(state, horizon)?;
    by_event::check_closed_form(&now.system, "path").map_err(|it| it.about(Subject::Query))?;
    let Settings { thermostat, shear_rate, pair_potential, .. } = state.settings;
    let is_free = thermostat.is_none() && shear_rate == 0.0 && pair_potential.is_none();
    let requirement = "predicted in a world without a thermostat, shear and a pair potential";
    validate::require(is_free, "path", requirement, "under one")
        .map_err(|invalid| invalid.about(Subject::Query))?;
    let parameters = match state.settings.rule {
        Rule::Exact(parameters) => parameters,
        Rule::Discrete(_) | Rule::Bisect(_) | Rule::Contact(_) => Exact::default(),
    };
    let begin = || exact::start(&now.system, parameters, now.motion, state.zone.clone(), now.time);
    let mut timeline = state.timeline.clone().unwrap_or_else(begin);
    exact::begin(&mut timeline, &now.system, [now.time, end], f64::INFINITY)
        .map_err(|error| by_event::refused_forces(error, now.time))?;
    let span = Span { start: now.time, length: horizon, end };
    let work = Work::new(stop_request);
    let course =
        exact::follow(&mut timeline, &now.system, (index as u32, most_impacts), span, &work);
    let exact::Course { legs, impacts, end } =
        course.map_err(|_| Error::Stopped { time: now.time })?;
    Ok(PredictedPath { legs, impacts, end, period: state.settings.boundary.period() })
}
