//! What non-additive contact distances can be combined with.

use crate::error::{Error, Subject};
use crate::friction::Friction;
use crate::id::EmitterId;
use crate::material_pair::MaterialPair;
use crate::state::State;
use crate::validate;

const SMOOTH: &str = "0 for a sphere that is not additive with another material, unless the pair of materials has a \
                      friction of 0";

/// Returns an error for friction between spheres that are not additive: no point of their contact is on both.
///
/// # Errors
/// [`Error::Invalid`] about the first sphere with friction, or its emitter.
pub(super) fn check(state: &State) -> Result<(), Error> {
    if state.material_pairs.non_additivity.is_none() {
        return Ok(());
    }
    let pairs = state.material_pairs.list().iter();
    let pairs: Vec<&MaterialPair> = pairs.filter(|pair| pair.non_additivity != 0.0).collect();
    let check = |material: u8, friction: Friction, subject: Subject| {
        let left = pairs.iter().filter(|pair| pair.materials.contains(&material));
        let mut left = left.map(|pair| left_open(pair, friction));
        validate::require(!left.any(|it| it.acts()), "friction", SMOOTH, largest(friction))
            .map_err(|invalid| invalid.about(subject))
    };
    let spheres = &state.spheres.properties;
    let rough = if spheres.friction.is_empty() { 0 } else { spheres.id.len() };
    for index in 0..rough {
        check(
            spheres.material(index),
            spheres.friction(index),
            Subject::Sphere(spheres.id[index]),
        )?;
    }
    for (number, it) in state.emitters.iter() {
        let sphere = &it.emitter.sphere;
        check(sphere.material, sphere.friction, Subject::Emitter(EmitterId(number)))?;
    }
    Ok(())
}

/// The friction of a sphere, where a pair of materials gives no other.
fn left_open(pair: &MaterialPair, friction: Friction) -> Friction {
    let given = pair.friction;
    Friction {
        sliding: given.sliding.or(friction.sliding),
        rolling: given.rolling.or(friction.rolling),
        spinning: given.spinning.or(friction.spinning),
        ..friction
    }
}

/// The largest coefficient of friction.
fn largest(friction: Friction) -> f64 {
    let coefficients = [friction.sliding, friction.rolling, friction.spinning];
    coefficients.into_iter().flatten().fold(0.0, f64::max)
}
