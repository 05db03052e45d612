//! Parts of a scene described in code.

use carom_scene::scene::MaterialPair;
use carom_scene::{Scene, part};

use crate::failure::Failure;

/// Reads spheres, colliders and the like from TOML: see [`part::read`].
///
/// # Errors
/// [`Failure`] for anything that a scene file would be refused for.
pub fn read(text: &str) -> Result<Scene, Failure> {
    Ok(part::read(text)?)
}

/// Reads bodies for the world of a scene: see [`part::read_for`].
///
/// # Errors
/// [`Failure`] for anything that a scene file would be refused for.
pub fn read_for(text: &str, scene: &Scene) -> Result<Scene, Failure> {
    Ok(part::read_for(text, scene)?)
}

/// Reads pairs of materials for the world of a scene: see [`part::material_pairs`].
///
/// # Errors
/// [`Failure`] for anything that a scene file would be refused for.
pub fn material_pairs(
    text: &str,
    scene: &Scene,
) -> Result<(Vec<MaterialPair>, Vec<carom::MaterialPair>), Failure> {
    Ok(part::material_pairs(text, scene)?)
}

/// Reads simulation settings from TOML.
///
/// # Errors
/// [`Failure`] for anything that a scene file would be refused for.
pub fn read_simulation(text: &str) -> Result<Scene, Failure> {
    Ok(part::read_simulation(text)?)
}

/// Returns the single item of a description: see [`part::only`].
///
/// # Errors
/// [`Failure`] for another number of items.
pub fn only<T>(list: &[T]) -> Result<&T, Failure> {
    Ok(part::only(list)?)
}
