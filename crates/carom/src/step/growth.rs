//! What growing spheres can be combined with.

use super::obstacle;
use crate::collider::{Collider, Shape};
use crate::error::{Error, Subject};
use crate::id::SphereId;
use crate::settings::Rule;
use crate::state::State;
use crate::surface::{Role, Surface};
use crate::validate;

/// Returns an error for growing spheres in a world that a step of `h` \[s\] cannot combine with growth.
///
/// # Errors
/// [`Error::Invalid`] with the first sphere that grows, or if a periodic box becomes too small.
pub(super) fn check(state: &State, h: f64) -> Result<(), Error> {
    let spheres = &state.spheres.properties;
    let Some(index) = spheres.growth_speed.iter().position(|&speed| speed > 0.0) else {
        return Ok(());
    };
    let sphere: SphereId = spheres.id[index];
    let requirement = obstacle(state);
    validate::require(
        requirement.is_none(),
        "growth_speed",
        requirement.unwrap_or_default(),
        spheres.growth_speed[index],
    )
    .map_err(|invalid| invalid.about(Subject::Sphere(sphere)))?;
    state.check_grown(h)
}

/// Returns what prevents growth, if anything.
fn obstacle(state: &State) -> Option<&'static str> {
    let surfaces = || state.colliders.surfaces().iter();
    let is_mesh = |(_, it): (u64, &Collider)| matches!(it.shape, Shape::Mesh(_));
    let spheres = &state.spheres;
    let mut restitutions = (0..spheres.len()).map(|it| spheres.properties.restitution(it));
    let has_inelastic = !restitutions.all(|it| it.is_elastic())
        || !surfaces().all(|it| it.restitution.is_elastic())
        || !state.material_pairs.are_elastic();
    let moves = |it: &Surface| !it.motion.is_at_rest() || it.kick != 0.0;
    let reports = |it: &Surface| it.role == Role::Reports;
    let is_other_rule = !matches!(state.settings.rule, Rule::Exact(_));
    let of_rule = (is_other_rule, "zero under rules other than `exact`");
    let others = [
        (has_inelastic, "zero where a restitution is not 1"),
        (state.emitters.iter().len() > 0, "zero in a world with emitters"),
        (state.settings.thermostat.is_some(), "zero beside a thermostat"),
        (state.settings.pair_potential.is_some(), "zero beside a pair potential"),
        (state.settings.shear_rate != 0.0, "zero in a box in steady shear"),
        (surfaces().any(moves), "zero beside colliders that move or kick"),
        (surfaces().any(reports), "zero beside triggers"),
        (state.colliders.list().iter().any(is_mesh), "zero beside meshes"),
    ];
    let of_forces = obstacle::of_forces(state);
    obstacle::first([of_rule].into_iter().chain(of_forces).chain(others))
}
