//! Steady shear of a periodic box: what it can be combined with, and its work in impacts.

use super::attempt::Attempt;
use super::obstacle;
use crate::error::{Error, Subject};
use crate::report::BodyPair;
use crate::settings::Rule;
use crate::shear::Shear;
use crate::state::State;
use crate::sum::Sum;
use crate::validate;

/// Neighbours are found again each time images have slid by half the mean distance of spheres, so a large strain takes
/// long.
const MOST_STRAIN: f64 = 100.0;
const TOO_FAST: &str = "at most 100 divided by the length of a step";

/// Adds the work of shear in the impacts of a step: they change velocities, and not those of the mean flow at the two
/// centres.
pub(super) fn account_for_impacts(attempt: &mut Attempt) {
    let Some(shear) = Shear::of(&attempt.state.settings) else { return };
    let spheres = &attempt.state.spheres;
    let system = attempt.state.now().system;
    let index_of = |id| spheres.index_of(id).map(|index| index as u32);
    let works = attempt.report.impacts.iter().map(|impact| {
        let BodyPair::Spheres(first, second) = impact.between else { return 0.0 };
        let Some(pair) = index_of(first).zip(index_of(second)) else { return 0.0 };
        let height = system.contact_radii(pair.into()).into_iter().sum::<f64>() * impact.normal.y;
        -shear.rate * height * impact.impulse * impact.normal.x
    });
    attempt.report.energy_account.shear += works.collect::<Sum>().value();
}

/// Returns an error for a world in steady shear with something that shear cannot be combined with, or with too much
/// strain in a step of `dt` \[s\].
///
/// # Errors
/// [`Error::Invalid`] about the settings.
pub(super) fn check(state: &State, dt: f64) -> Result<(), Error> {
    if Shear::of(&state.settings).is_none() {
        return Ok(());
    }
    let rate = state.settings.shear_rate;
    let is_slow = rate.abs() * dt <= MOST_STRAIN;
    let requirement = obstacle(state).or((!is_slow).then_some(TOO_FAST));
    validate::require(requirement.is_none(), "shear_rate", requirement.unwrap_or_default(), rate)
        .map_err(|invalid| invalid.about(Subject::Settings))
}

/// Returns what prevents shear, if anything.
fn obstacle(state: &State) -> Option<&'static str> {
    let others = [
        (state.emitters.iter().len() > 0, "zero in a world with emitters"),
        (state.colliders.list().iter().len() > 0, "zero in a world with colliders"),
    ];
    let [forces, rotation @ ..] = obstacle::of_forces(state);
    let is_exact = matches!(state.settings.rule, Rule::Exact(_));
    let rotation = rotation.into_iter().filter(|_| is_exact);
    obstacle::first(others.into_iter().chain([forces]).chain(rotation))
}
