//! What non-additive contact distances can be combined with.

use crate::error::{Error, Subject};
use crate::friction::Friction;
use crate::material_pair::MaterialPair;
use crate::state::State;
use crate::validate;

/// Returns an error for friction between spheres that are not additive: no point of their contact is on both.
///
/// # Errors
/// [`Error::Invalid`] about the settings.
pub(super) fn check(state: &State) -> Result<(), Error> {
    if state.material_pairs.non_additivity.is_none() {
        return Ok(());
    }
    let pairs = state.material_pairs.list().iter();
    for pair in pairs.filter(|pair| pair.non_additivity != 0.0) {
        validate::require(
            !has_friction(state, pair),
            "non_additivity",
            "0 where friction acts between the spheres; a friction of 0 in the pair of materials removes it",
            pair.non_additivity,
        )
        .map_err(|invalid| invalid.about(Subject::Settings))?;
    }
    Ok(())
}

/// Whether friction may act between spheres of two materials.
fn has_friction(state: &State, pair: &MaterialPair) -> bool {
    let given = pair.friction;
    // What the pair leaves open is that of its spheres.
    let left = |friction: Friction| Friction {
        sliding: given.sliding.or(friction.sliding),
        rolling: given.rolling.or(friction.rolling),
        spinning: given.spinning.or(friction.spinning),
        ..friction
    };
    let spheres = &state.spheres.properties;
    let is_of_pair = |material: u8| pair.materials.contains(&material);
    let mut present = (0..spheres.id.len()).filter(|&index| is_of_pair(spheres.material(index)));
    let mut emitted = state.emitters.iter().map(|(_, it)| &it.emitter.sphere);
    given.acts()
        || (!spheres.friction.is_empty()
            && present.any(|index| left(spheres.friction(index)).acts()))
        || emitted.any(|sphere| is_of_pair(sphere.material) && left(sphere.friction).acts())
}
