//! Parts of a scene, described in code.

use carom_scene::{Scene, part};

use crate::failure::Failure;

/// Reads spheres, colliders and the like from TOML: see [`part::read`].
///
/// # Errors
/// [`Failure`] for whatever a scene file would be refused for.
pub fn read(text: &str) -> Result<Scene, Failure> {
    Ok(part::read(text)?)
}

/// Reads how a world is stepped from TOML.
///
/// # Errors
/// [`Failure`] for whatever a scene file would be refused for.
pub fn read_simulation(text: &str) -> Result<Scene, Failure> {
    Ok(part::read_simulation(text)?)
}

/// The one thing that a description is of: see [`part::only`].
///
/// # Errors
/// [`Failure`] for more or less.
pub fn only<T>(list: &[T]) -> Result<&T, Failure> {
    Ok(part::only(list)?)
}
