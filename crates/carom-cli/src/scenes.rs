//! The commands `scenes`, `check` and `show`.

use std::io::{self, Write};
use std::path::PathBuf;

use carom_scene::{Budget, Entry, Library, Scene, SceneText, remarks};
use serde_json::json;

use crate::advice::unread;
use crate::args::Show;
use crate::failure::{Failure, complain, legible};
use crate::standard_input::{self, STANDARD};

/// Lists every scene.
pub fn list(library: &Library, json: bool) -> Result<(), Failure> {
    let entries = library.entries()?;
    let mut out = io::stdout().lock();
    if json {
        let list: Vec<_> = entries.iter().map(as_json).collect();
        writeln!(out, "{:#}", serde_json::Value::from(list))?;
        return Ok(());
    }
    for Entry { name, source, scene } in &entries {
        let (name, source) = (legible(name), legible(&source.to_string()));
        match scene {
            Ok(scene) => {
                let title = if scene.title.is_empty() { &name } else { &scene.title };
                writeln!(out, "{name:<12} {title}")?;
                if !scene.description.is_empty() {
                    writeln!(out, "{:12} {}", "", scene.description)?;
                }
                let origin = if scene.origin.is_empty() { "" } else { " - " };
                writeln!(out, "{:12} [{source}{origin}{}]", "", scene.origin)?;
            }
            Err(error) => {
                writeln!(out, "{name:<12} cannot be read: {}", legible(&error.to_string()))?
            }
        }
        writeln!(out)?;
    }
    writeln!(out, "{} scenes; `carom run NAME` runs one.", entries.len())?;
    Ok(())
}

fn as_json(entry: &Entry) -> serde_json::Value {
    let source = entry.source.to_string();
    match &entry.scene {
        Ok(Scene { name, title, description, origin, .. }) => json!({
            "name": name,
            "title": title,
            "description": description,
            "origin": origin,
            "source": source,
        }),
        Err(error) => json!({ "name": entry.name, "source": source, "error": error.to_string() }),
    }
}

/// Checks scenes, each of a file or a name; reports every broken one before the command fails.
pub fn check(library: &Library, files: &[PathBuf], budget: Budget) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    let mut broken = 0;
    for file in files {
        let is_standard = file.as_os_str() == STANDARD;
        let name = if is_standard { standard_input::NAME.into() } else { file.to_string_lossy() };
        let scene = if is_standard {
            let text = SceneText::new(standard_input::text()?, &name);
            text.and_then(|text| text.within(budget).scene(&[]))
        } else if file.exists() {
            let text = SceneText::from_file_within(file, budget);
            text.and_then(|text| text.within(budget).scene(&[]))
        } else {
            library.find(&name, &[]).map(|(scene, _)| scene)
        };
        match scene {
            Ok(scene) => {
                writeln!(out, "{}: ok, \"{}\"", legible(&name), scene.name)?;
                let remarks = mesh_remarks_of(&scene).into_iter().chain(remarks(&scene));
                for advice in remarks.chain(advice_for(&scene)) {
                    writeln!(out, "{}: {advice}", legible(&name))?;
                }
            }
            Err(error) => {
                let faults = if is_standard {
                    Scene::faults(standard_input::text()?, &name, budget)
                } else {
                    Scene::faults_of_file(file, budget).unwrap_or_default()
                };
                // A single fault is identical to the error.
                if faults.len() > 1 {
                    faults.iter().for_each(|fault| complain(&fault.to_string()));
                } else {
                    complain(&error.to_string());
                }
                broken += 1;
            }
        }
    }
    match broken {
        0 => Ok(()),
        _ => Err(Failure::Fault(format!("{broken} of {} scenes are broken", files.len()))),
    }
}

/// Returns what the author of a valid scene may not have intended in its meshes.
fn mesh_remarks_of(scene: &Scene) -> Vec<String> {
    let Ok(world) = scene.world() else { return Vec::new() };
    let of_collider =
        |(number, (_, collider)): (usize, (_, &carom::Collider))| match &collider.shape {
            carom::Shape::Mesh(mesh) => carom_scene::mesh_remarks(mesh)
                .into_iter()
                .map(|remark| format!("the mesh of collider {number}: {remark}"))
                .collect(),
            _ => Vec::new(),
        };
    world.colliders().enumerate().flat_map(of_collider).collect()
}

/// The fields of a valid scene that its rule ignores, in a sentence.
fn advice_for(scene: &Scene) -> Option<String> {
    unread(&scene.simulation, &scene.world().ok()?)
}

/// Prints a scene as TOML.
pub fn show(library: &Library, show: &Show) -> Result<(), Failure> {
    let mut scene = show.choice.find(library, [])?;
    if show.expand {
        scene = scene.expanded()?;
    }
    io::stdout().lock().write_all(scene.to_toml().as_bytes())?;
    Ok(())
}
