//! Parts of a scene, described in code: read and checked as if they were a scene of their own.

use carom_scene::Scene;

use crate::failure::Failure;

/// Reads spheres, colliders and the like from TOML: the tables of a scene file that are needed,
/// without a name.
///
/// Spheres in it may overlap, as in a world to which they are added one by one.
///
/// # Errors
/// [`Failure`] for whatever a scene file would be refused for.
pub fn read(text: &str) -> Result<Scene, Failure> {
    let overlapping = ["simulation.allow_overlap=true".parse()?];
    Scene::from_toml_with(&named(text), NAME, &overlapping).map_err(Failure::of_part)
}

/// Reads how a world is stepped from TOML.
///
/// # Errors
/// [`Failure`] for whatever a scene file would be refused for.
pub fn read_simulation(text: &str) -> Result<Scene, Failure> {
    Scene::from_toml(&named(text), NAME).map_err(Failure::of_part)
}

/// What a description is made for: exactly one thing.
///
/// # Errors
/// [`Failure`] for more or less.
pub fn only<T>(list: &[T]) -> Result<&T, Failure> {
    match list {
        [one] => Ok(one),
        _ => Err(Failure::value("part", format_args!("must be one thing, not {}", list.len()))),
    }
}

/// What a part is called where an error has no field to name.
const NAME: &str = "part";

fn named(text: &str) -> String {
    format!("name = \"{NAME}\"\n{text}")
}
