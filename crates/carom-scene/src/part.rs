//! Parts of a scene, described in code: read and checked as if they were a scene of their own.

use serde::Deserialize;
use thiserror::Error;

use crate::error::{Fault, SceneError};
use crate::legible::legible;
use crate::overrides::Override;
use crate::scene::{Scene, Spring};

/// What is wrong with something that was described in code: it has no lines, and no name.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{message}")]
pub struct PartError {
    /// What is wrong, the field first.
    pub message: String,
    /// Path of the field, like `colliders[0].restitution`; empty for none.
    pub field: String,
}

impl From<SceneError> for PartError {
    fn from(error: SceneError) -> Self {
        let SceneError::Invalid(fault) = error else {
            return Self { message: error.to_string(), field: String::new() };
        };
        let field = fault.field.clone();
        // The field stands where a file has its name and line.
        let name = if field.is_empty() { fault.source_name } else { fault.field };
        let told = Fault { source_name: name, field: String::new(), line: None, ..fault };
        Self { message: told.to_string(), field }
    }
}

/// Reads spheres, colliders and the like from TOML: the tables of a scene file that are needed,
/// without a name.
///
/// Spheres in it may overlap, as in a world to which they are added one by one.
///
/// # Errors
/// [`PartError`] for whatever a scene file would be refused for.
pub fn read(text: &str) -> Result<Scene, PartError> {
    let overlapping: Override = "simulation.allow_overlap=true".parse()?;
    Ok(Scene::from_toml_with(&named(text), NAME, &[overlapping])?)
}

/// Reads how a world is stepped from TOML.
///
/// # Errors
/// [`PartError`] for whatever a scene file would be refused for.
pub fn read_simulation(text: &str) -> Result<Scene, PartError> {
    Ok(Scene::from_toml(&named(text), NAME)?)
}

/// Reads springs from TOML, without the spheres that they join: the world that they come into has those.
///
/// # Errors
/// [`PartError`] for what is no spring.
pub fn springs(text: &str) -> Result<Vec<Spring>, PartError> {
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Springs {
        #[serde(default)]
        springs: Vec<Spring>,
    }
    let read = toml::from_str::<Springs>(text).map(|it| it.springs);
    let failed = |error: toml::de::Error| PartError {
        message: format!("springs: {}", legible(error.message(), LONGEST)),
        field: "springs".to_owned(),
    };
    read.map_err(failed)
}

/// Longest message of the reader of TOML \[characters\].
const LONGEST: usize = 300;

/// The one thing that a description is of.
///
/// # Errors
/// [`PartError`] where it is of more things, or of none.
pub fn only<T>(list: &[T]) -> Result<&T, PartError> {
    match list {
        [one] => Ok(one),
        _ => Err(PartError {
            message: format!("this takes one description, not {}", list.len()),
            field: String::new(),
        }),
    }
}

/// What a part is called where an error has no field to name.
const NAME: &str = "part";

fn named(text: &str) -> String {
    format!("name = \"{NAME}\"\n{text}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spheres_of_a_part_may_overlap() {
        let part = read("spheres = [{ radius = 1.0 }, { radius = 2.0 }]").unwrap();
        assert_eq!(part.world().unwrap().spheres().len(), 2);
    }

    #[test]
    fn a_fault_is_told_by_its_field_and_not_by_a_line() {
        let error = read("spheres = [{ radius = -1.0 }]").unwrap_err();
        assert_eq!(error.field, "spheres[0].radius");
        assert!(error.message.starts_with("spheres[0].radius: "), "{error}");
        let error = read("spheres = [").unwrap_err();
        assert_eq!(error.field, "");
        assert!(error.message.starts_with("part: "), "{error}");
        let error = read_simulation("simulation = { frame_time = 0.0 }").unwrap_err();
        assert_eq!(error.field, "simulation.frame_time");
    }
}
