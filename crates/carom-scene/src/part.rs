//! Reads parts of a scene that code describes in TOML, with the checks of a whole scene.

use carom::World;
use serde::Deserialize;
use thiserror::Error;
use toml::Table;

use crate::deserialize::deserialize;
use crate::error::{Fault, Problem, SceneError};
use crate::legible::legible;
use crate::overrides::Override;
use crate::scene::{MaterialPair, Scene, Spring};
use crate::{materials, parameters, springs};

/// An error in a part described in code, which has no lines and no file name.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{message}")]
pub struct PartError {
    /// Description of the error; it starts with the field.
    pub message: String,
    /// Path of the field, such as `colliders[0].restitution`; empty if no field is concerned.
    pub field: String,
}

impl From<SceneError> for PartError {
    fn from(error: SceneError) -> Self {
        let SceneError::Invalid(fault) = error else {
            return Self { message: error.to_string(), field: String::new() };
        };
        let field = fault.field.clone();
        // The message names the field where that of a file names the file and the line.
        let name = if field.is_empty() { fault.source_name } else { fault.field };
        let told = Fault { source_name: name, field: String::new(), line: None, ..fault };
        Self { message: told.to_string(), field }
    }
}

/// Reads spheres, colliders and other parts from TOML: any tables of a scene file, without a name.
///
/// The spheres may overlap, because a world may also have overlapping spheres when they are added
/// one by one.
///
/// # Errors
/// [`PartError`] for any error that a scene file could have.
pub fn read(text: &str) -> Result<Scene, PartError> {
    let overlapping: Override = "simulation.allow_overlap=true".parse()?;
    Ok(Scene::from_toml_with(&named(text), NAME, &[overlapping])?)
}

/// Reads parts for a running world, whose bodies may be of the materials of its `scene`.
///
/// # Errors
/// [`PartError`] for any error that a scene file could have, and for materials of the text itself: a world has those of
/// its scene.
pub fn read_for(text: &str, scene: &Scene) -> Result<Scene, PartError> {
    let part = read_of_materials(text, scene)?;
    if part.material_pairs.is_empty() { Ok(part) } else { Err(materials_stay()) }
}

/// Reads pairs of materials for a running world, whose materials are those of its `scene`. Returns their descriptions
/// and the pairs for [`World::set_material_pairs`].
///
/// # Errors
/// [`PartError`] for any error that a scene file could have, and for materials of the text itself.
pub fn material_pairs(
    text: &str,
    scene: &Scene,
) -> Result<(Vec<MaterialPair>, Vec<carom::MaterialPair>), PartError> {
    let part = read_of_materials(text, scene)?;
    let pairs = part.world()?.material_pairs().to_vec();
    Ok((part.material_pairs, pairs))
}

/// Reads parts together with the materials of `scene`.
fn read_of_materials(text: &str, scene: &Scene) -> Result<Scene, PartError> {
    let part = if scene.materials.is_empty() {
        read(text)?
    } else {
        read(&format!("{text}\n{}", materials::written(scene)))?
    };
    if part.materials == scene.materials { Ok(part) } else { Err(materials_stay()) }
}

fn materials_stay() -> PartError {
    PartError {
        message: "materials: a running world has those of its scene".to_owned(),
        field: "materials".to_owned(),
    }
}

/// Reads the simulation settings from TOML.
///
/// # Errors
/// [`PartError`] for any error that a scene file could have.
pub fn read_simulation(text: &str) -> Result<Scene, PartError> {
    Ok(Scene::from_toml(&named(text), NAME)?)
}

/// Reads springs from TOML without the spheres that they join; the world has those.
///
/// # Errors
/// [`PartError`] if the text does not describe springs.
pub fn springs(text: &str) -> Result<Vec<Spring>, PartError> {
    let read = |text: &str| {
        let mut table: Table = text.parse().map_err(|error: toml::de::Error| {
            Problem::new("springs", legible(error.message(), LONGEST))
        })?;
        parameters::resolve(&mut table)?;
        deserialize::<Springs>(table)
    };
    Ok(read(text).map_err(in_part)?.springs)
}

/// The table of springs of a scene file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Springs {
    #[serde(default)]
    springs: Vec<Spring>,
}

/// Reads one spring from TOML for a running world, where the text names spheres by id. If the text
/// states no rest length, it is the present distance of the two spheres.
///
/// # Errors
/// [`SpringError`] if the text does not describe a single spring, or names spheres that the world
/// does not have.
pub fn spring_of(text: &str, world: &World) -> Result<carom::Spring, SpringError> {
    let springs = springs(text)?;
    let (sphere, to) = springs::ends_by_id(only(&springs)?, "springs[0]").map_err(in_part)?;
    Ok(springs::between(&springs[0], world, sphere, to)?)
}

/// Why a spring described in code cannot be added to a world.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum SpringError {
    /// The description is invalid.
    #[error(transparent)]
    Part(#[from] PartError),
    /// The world refuses the spring.
    #[error(transparent)]
    World(#[from] carom::Error),
}

/// Converts a problem of a part described in code.
fn in_part(problem: Problem) -> PartError {
    SceneError::from(problem.in_code(NAME)).into()
}

/// Longest message of the TOML parser \[characters\].
const LONGEST: usize = 300;

/// Returns the only element of a list.
///
/// # Errors
/// [`PartError`] if the list has no element or several.
pub fn only<T>(list: &[T]) -> Result<&T, PartError> {
    match list {
        [one] => Ok(one),
        _ => Err(PartError {
            message: format!("this takes one description, not {}", list.len()),
            field: String::new(),
        }),
    }
}

/// Name of the part in errors that concern no field.
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
        // The present distance of the spheres.
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
    fn pairs_of_a_running_world_name_the_materials_of_its_scene() {
        let scene = "name = 'a'\n[materials]\nivory = {}\nslate = {}";
        let scene = Scene::from_toml(scene, "a").unwrap();
        let text = |names: &str| {
            format!("material_pairs = [{{ materials = {names}, restitution = 0.5 }}]")
        };
        let (described, pairs) = material_pairs(&text("['slate', 'ivory']"), &scene).unwrap();
        assert_eq!(described[0].materials, ["slate", "ivory"]);
        assert_eq!(pairs, [carom::MaterialPair::new(2, 1).with_restitution(0.5)]);
        assert_eq!(material_pairs("", &scene).unwrap().1, []);
        let error = material_pairs(&text("['slate', 'cork']"), &scene).unwrap_err();
        assert_eq!(error.field, "material_pairs[0].materials");
        let own = format!("{}\nmaterials = {{ cork = {{}} }}", text("['cork', 'cork']"));
        assert!(material_pairs(&own, &scene).is_err());
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
