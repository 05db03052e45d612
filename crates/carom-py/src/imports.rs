//! Imports of scenes from other programs.

// Python shows these comments as docstrings, with units in plain brackets.
#![allow(rustdoc::broken_intra_doc_links)]

use std::path::{Path, PathBuf};

use carom_scene::Scene;
use carom_scene::import::Omission;
use carom_scene::recording::{ParticleFormat, ParticleOptions, import_particles};
use pyo3::prelude::*;

use crate::failure::Failure;

/// A scene as JSON, and what the import left out, one line each.
type Imported = (String, Vec<String>);

/// Imports a Unity scene from a file, or from a folder by its name or its path in the folder.
/// `scene` may be missing if the folder has one scene. `mapping` is a file that explains fields of
/// scripts.
#[pyfunction]
pub fn import_unity(
    path: PathBuf,
    scene: Option<String>,
    mapping: Option<PathBuf>,
) -> Result<Imported, Failure> {
    let refused = Failure::of_import;
    let project = carom_unity::Project::around(&path).map_err(refused)?;
    let file = if path.is_dir() {
        let scenes = project.scenes(&path).map_err(refused)?;
        chosen(&path, &scenes, scene.as_deref())?
    } else {
        if scene.is_some() {
            return Err(Failure::value("scene", "the path is that of a scene already"));
        }
        path
    };
    let mut options = carom_unity::Options::default();
    if let Some(mapping) = mapping {
        options.mapping = carom_unity::Mapping::from_file(&mapping).map_err(refused)?;
    }
    let imported = carom_unity::import(&file, &project, &options).map_err(refused)?;
    answer(&imported.scene, &imported.omissions)
}

/// Imports a glTF scene.
#[pyfunction]
pub fn import_gltf(path: PathBuf) -> Result<Imported, Failure> {
    let imported = carom_gltf::import(&path, &carom_gltf::Options::default());
    let imported = imported.map_err(Failure::of_import)?;
    answer(&imported.scene, &imported.omissions)
}

/// Imports a frame of a particle file, from 0; the last one unless given. `radius` [m] is that of
/// every particle, for a file without radii.
#[pyfunction]
pub fn import_particle_file(
    path: PathBuf,
    frame: Option<u64>,
    radius: Option<f64>,
) -> Result<Imported, Failure> {
    let format = ParticleFormat::of(&path).ok_or_else(|| {
        let endings = "use .xyz, .extxyz, .lammpstrj, .dump or .gsd";
        Failure::of_file(format!("{} has no known format: {endings}", path.display()))
    })?;
    let options = ParticleOptions { frame, radius, ..ParticleOptions::default() };
    let imported = import_particles(&path, format, &options).map_err(Failure::of_import)?;
    answer(&imported.scene, &imported.omissions)
}

/// Returns the scene in a folder with this name or path.
fn chosen(folder: &Path, scenes: &[PathBuf], name: Option<&str>) -> Result<PathBuf, Failure> {
    let is_it = |scene: &&PathBuf| match name {
        None => true,
        Some(name) => {
            let within = scene.strip_prefix(folder).unwrap_or(scene);
            let stem = scene.file_stem().is_some_and(|stem| stem == name);
            stem || within == Path::new(name) || within.with_extension("") == Path::new(name)
        }
    };
    let found: Vec<&PathBuf> = scenes.iter().filter(is_it).collect();
    match found[..] {
        [scene] => Ok(scene.clone()),
        _ => {
            let all: Vec<String> = scenes
                .iter()
                .map(|it| it.strip_prefix(folder).unwrap_or(it).display().to_string())
                .collect();
            let problem = if found.is_empty() { "there is no such scene" } else { "say which" };
            Err(Failure::value("scene", format!("{problem}: {}", all.join(", "))))
        }
    }
}

fn answer(scene: &Scene, omissions: &[Omission]) -> Result<Imported, Failure> {
    let lines = omissions.iter().map(ToString::to_string).collect();
    Ok((serde_json::to_string(scene)?, lines))
}
