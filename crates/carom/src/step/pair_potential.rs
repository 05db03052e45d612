//! What a potential between spheres can be combined with.

use super::obstacle;
use crate::error::{Error, Subject};
use crate::forces;
use crate::settings::PairPotential;
use crate::state::State;
use crate::surface::Surface;
use crate::validate;

/// Returns an error for a world with a potential between spheres and something that it cannot be combined with.
///
/// # Errors
/// [`Error::Invalid`] about the settings.
pub(super) fn check(state: &State) -> Result<(), Error> {
    let Some(PairPotential::SquareWell { depth, range_ratio }) = state.settings.pair_potential
    else {
        return Ok(());
    };
    let requirement = obstacle(state);
    validate::require(
        requirement.is_none(),
        "pair_potential",
        requirement.unwrap_or_default(),
        format!("a square well of {depth} J to {range_ratio} diameters"),
    )
    .map_err(|invalid| invalid.about(Subject::Settings))
}

/// Returns what prevents a potential between spheres, if anything.
fn obstacle(state: &State) -> Option<&'static str> {
    let now = state.now();
    let spheres = &state.spheres;
    let is_elastic = |surface: &Surface| surface.restitution.is_elastic();
    let mut restitutions = (0..spheres.len()).map(|it| spheres.properties.restitution(it));
    let has_inelastic = !restitutions.all(|it| it.is_elastic())
        || !state.colliders.surfaces().iter().all(is_elastic)
        || !state.material_pairs.is_empty();
    let [_, friction, _] = obstacle::of_forces(state);
    let has_links = now.system.has_interactions() || !spheres.applied_forces().is_empty();
    let others = [
        (has_links || !falls_alike(state), "absent where forces other than gravity act on spheres"),
        (friction.0, "absent where friction acts"),
        (has_inelastic, "absent where a restitution is not 1, and beside pairs of materials"),
        (state.emitters.iter().len() > 0, "absent in a world with emitters"),
        (state.settings.shear_rate != 0.0, "absent in a box in steady shear"),
    ];
    obstacle::first(others)
}

/// Whether all spheres fall with one acceleration.
fn falls_alike(state: &State) -> bool {
    let properties = &state.spheres.properties;
    let mut flights = properties
        .radius
        .iter()
        .zip(&properties.mass)
        .map(|(&radius, &mass)| forces::total_linear(&state.forces, radius, mass));
    let Some((first, is_all)) = flights.next() else { return true };
    let is_like = |(force, is_all): (forces::LinearForce, bool)| {
        is_all && force.drag_rate == 0.0 && force.acceleration == first.acceleration
    };
    is_all && first.drag_rate == 0.0 && (state.forces.iter().len() == 0 || flights.all(is_like))
}
