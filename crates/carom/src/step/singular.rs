//! Places where a force has no bound.

use crate::emitter::EmitterState;
use crate::error::{Error, Subject};
use crate::forces;
use crate::id::EmitterId;
use crate::sphere::Sphere;
use crate::state::State;
use crate::validate;

const WITH_ENERGY: &str = "where the potential energy of every force is finite (at the point of an attractor, it is with a \
                           `softening`)";

/// Returns an error for a sphere that is, or will be emitted, where a force has no finite potential energy: no account
/// of energy closes there.
///
/// # Errors
/// [`Error::Invalid`] with the first such sphere, or its emitter.
pub(super) fn check(state: &State) -> Result<(), Error> {
    if forces::are_linear(&state.forces) {
        return Ok(());
    }
    for (index, &id) in state.spheres.ids().iter().enumerate() {
        check_sphere(state, &state.spheres.get(index), Subject::Sphere(id))?;
    }
    for (number, EmitterState { emitter, .. }) in state.emitters.iter() {
        check_sphere(state, &emitter.emitted(), Subject::Emitter(EmitterId(number)))?;
    }
    Ok(())
}

fn check_sphere(state: &State, sphere: &Sphere, subject: Subject) -> Result<(), Error> {
    let (present, time) = (sphere.state(), state.clock.seconds());
    let mut energies = state.forces.iter().map(|(_, force)| force.potential_energy(&present, time));
    let holds = energies.all(f64::is_finite);
    validate::require(holds, "position", WITH_ENERGY, sphere.position)
        .map_err(|invalid| invalid.about(subject))
}
