//! Reads, writes and finds scenes.

use std::path::PathBuf;

use carom_scene::{Budget, Library, Override, Scene, SceneError, Source};
use pyo3::prelude::*;

use crate::failure::Failure;

/// Returns the scene that Python code wrote as TOML.
pub fn in_code(text: &str) -> Result<Scene, SceneError> {
    Scene::from_toml_within(text, "scene", Budget::MOST)
}

/// Reads a scene from TOML with some values replaced (`path=value`). Returns it as JSON; infinite
/// numbers are `null`. `source` is its name in errors.
#[pyfunction]
pub fn read_scene(text: &str, source: &str, overrides: Vec<String>) -> Result<String, Failure> {
    let scene = Scene::from_toml_with(text, source, &parsed(&overrides)?)?;
    in_json(&scene)
}

/// Reads a scene file and the files that it includes, like [`read_scene`].
#[pyfunction]
pub fn read_scene_file(path: PathBuf, overrides: Vec<String>) -> Result<String, Failure> {
    in_json(&Scene::from_file(&path, &parsed(&overrides)?)?)
}

/// Writes a scene as JSON, without what materials give its bodies.
fn in_json(scene: &Scene) -> Result<String, Failure> {
    Ok(if scene.materials.is_empty() {
        serde_json::to_string(scene)?
    } else {
        serde_json::to_string(&scene.to_table())?
    })
}

/// Returns the TOML of a scene with all defaults written out.
#[pyfunction]
pub fn canonical_toml(text: &str) -> Result<String, Failure> {
    Ok(in_code(text).map_err(Failure::of_part)?.to_toml())
}

/// Finds a scene by its name, title or file, as the command line does, among the scenes registered
/// in Python (name and title of each), those in folders, and the built-in ones.
///
/// Returns the scene as JSON, or the name of a registered scene, which Python must still make.
#[pyfunction]
pub fn find_scene(
    name: &str,
    overrides: Vec<String>,
    folders: Vec<PathBuf>,
    registered: Vec<(String, String)>,
) -> Result<(Option<String>, String), Failure> {
    let library = library(&folders, registered)?;
    let overrides = parsed(&overrides)?;
    // A registered scene is found by its name alone, because it has no values yet that could be
    // replaced.
    if let Ok((scene, Source::Registered)) = library.find(name, &[]) {
        return Ok((None, scene.name));
    }
    let (scene, source) = library.find(name, &overrides)?;
    Ok((Some(in_json(&scene)?), source.to_string()))
}

/// Returns name, title, description and source of all scenes.
#[pyfunction]
pub fn list_scenes(folders: Vec<PathBuf>) -> Result<Vec<[String; 4]>, Failure> {
    let entries = library(&folders, Vec::new())?.entries()?;
    let row = |entry: carom_scene::Entry| {
        let (name, source) = (entry.name, entry.source.to_string());
        match entry.scene {
            Ok(scene) => [name, scene.title, scene.description, source],
            Err(error) => [name, String::new(), format!("cannot be read: {error}"), source],
        }
    };
    Ok(entries.into_iter().map(row).collect())
}

fn library(folders: &[PathBuf], registered: Vec<(String, String)>) -> Result<Library, SceneError> {
    let mut library = Library::new();
    for (name, title) in registered {
        library.register(Scene { title, ..Scene::new(name) })?;
    }
    folders.iter().try_for_each(|folder| library.add_folder(folder))?;
    Ok(library)
}

fn parsed(overrides: &[String]) -> Result<Vec<Override>, SceneError> {
    overrides.iter().map(|text| text.parse()).collect()
}
