//! Parts of a scene, described in code: read and checked as if they were a scene of their own.

use carom::World;
use serde::Deserialize;
use thiserror::Error;
use toml::Table;

use crate::error::{Fault, Problem, SceneError};
use crate::legible::legible;
use crate::overrides::Override;
use crate::scene::{Scene, Spring};
use crate::{parameters, springs, table};

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
    let read = |text: &str| {
        let mut table: Table = text.parse().map_err(|error: toml::de::Error| {
            Problem::new("springs", legible(error.message(), LONGEST))
        })?;
        parameters::resolve(&mut table)?;
        table::told::<Springs>(table)
    };
    Ok(read(text).map_err(in_part)?.springs)
}

/// Springs by themselves, as a scene file has them.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Springs {
    #[serde(default)]
    springs: Vec<Spring>,
}

/// Reads one spring from TOML for a running world, in which spheres go by their ids: that spring between spheres of
/// `world`, with the length of now where the text gives no rest length.
///
/// # Errors
/// [`SpringError`] for what is no spring, for a chain, and for spheres that the world does not have.
pub fn spring_of(text: &str, world: &World) -> Result<carom::Spring, SpringError> {
    let springs = springs(text)?;
    let (sphere, to) = springs::ends_by_id(only(&springs)?, "springs[0]").map_err(in_part)?;
    Ok(springs::between(&springs[0], world, sphere, to)?)
}

/// Why a world gets no spring that was described in code.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum SpringError {
    /// The description makes no sense.
    #[error(transparent)]
    Part(#[from] PartError),
    /// The world refuses it.
    #[error(transparent)]
    World(#[from] carom::Error),
}

/// A problem of something that was described in code.
fn in_part(problem: Problem) -> PartError {
    SceneError::from(problem.in_code(NAME)).into()
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
    fn a_spring_of_a_running_world_names_spheres_by_their_ids() {
        let part = read("spheres = [{ radius = 1.0 }, { position = [3, 0, 0], radius = 1.0 }]");
        let mut world = part.unwrap().world().unwrap();
        let sphere = carom::Sphere::new(carom::DVec3::new(0.0, 0.0, 7.0), 1.0);
        let third = world.add_sphere(sphere).unwrap();
        world.remove_sphere(world.spheres().ids()[1]).unwrap();
        let text = "springs = [{ spheres = [0, 2], stiffness = '2 kN/m' }]";
        let spring = spring_of(text, &world).unwrap();
        assert_eq!((spring.to, spring.stiffness), (carom::SpringEnd::Sphere(third), 2000.0));
        // The length of now.
        assert_eq!(spring.rest_length, 7.0);
        let gone = "springs = [{ spheres = [0, 1], stiffness = 1.0 }]";
        let error = spring_of(gone, &world).unwrap_err();
        assert_eq!(error.to_string(), "there is no sphere 1 in this world");
    }

    #[test]
    fn a_spring_that_makes_no_sense_is_refused_by_its_field() {
        let world = World::default();
        for (spring, message) in [
            ("spheres = [3, 3], stiffness = 1.0", "springs[0].spheres: must be two spheres"),
            ("chain = [0, 3], stiffness = 1.0", "springs[0].chain: a running world takes"),
            ("sphere = 0, stiffness = 1.0", "springs[0]: needs `spheres`"),
            ("sphere = 0, anchor = [0, nan, 0], stiffness = 1.0", "springs[0].anchor: must be"),
            ("spheres = [0, 1], stiffness = nan", "springs[0].stiffness: must be zero"),
            ("spheres = [0, 1], stiffness = 1, rest_length = -1", "springs[0].rest_length: must"),
            ("spheres = [0, 1], stifness = 1.0", "springs[0].stifness: unknown field"),
            ("spheres = [0, 1], stiffness = '2 kg'", "springs[0].stiffness: "),
        ] {
            let error = spring_of(&format!("springs = [{{ {spring} }}]"), &world).unwrap_err();
            assert!(error.to_string().starts_with(message), "{error}");
        }
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
