//! Imports a glTF file as a scene.

mod appearance;
mod bodies;
mod building;
mod error;
mod file;
mod form;
mod graph;
mod meshes;
mod pose;
mod solid;
mod vertices;

use std::path::Path;

use carom_scene::SceneError;
use carom_scene::import::{Omission, made_runnable, omit, plain_name};
use carom_scene::scene::{Collider, Rule, Scene, Shape, Sphere};

use crate::document::Document;
use crate::extensions;
use appearance::Appearance;
use bodies::Bodies;
use building::Building;
use error::Malformed;
use file::File;
use graph::Placed;
use meshes::Meshes;
use solid::Solid;

pub use error::ImportError;

/// Properties that a glTF file does not state.
#[derive(Debug, Clone, Copy, Default)]
pub struct Options {
    /// Rule; the default is `exact`.
    pub rule: Option<Rule>,
    /// Length of a frame \[s\]; the default is that of a new scene.
    pub frame_time: Option<f64>,
    /// Duration \[s\]; the default is 10.
    pub duration: Option<f64>,
}

/// An imported scene.
#[derive(Debug)]
pub struct Imported {
    /// The scene, which is valid.
    pub scene: Scene,
    /// Parts of the file that were ignored, replaced or not understood.
    pub omissions: Vec<Omission>,
}

/// Imports a .gltf or .glb file. Buffers may be files in its folder or below.
///
/// If nodes use `KHR_physics_rigid_bodies`, these become spheres and colliders. Otherwise meshes
/// do: spheres move, boxes and rectangles are fixed.
///
/// # Errors
/// [`ImportError`] if a file cannot be read or is broken, or if the scene is invalid.
pub fn import(path: &Path, options: &Options) -> Result<Imported, ImportError> {
    let file = File::read(path)?;
    let name = path.file_stem().unwrap_or_default().to_string_lossy();
    let mut building = Building::new(&name);
    build(&file, &mut building).map_err(|fault| fault.in_file(path))?;
    let scene = &mut building.scene;
    scene.origin = plain_name(&format!(
        "glTF file {}",
        path.file_name().unwrap_or_default().to_string_lossy()
    ));
    let simulation = &mut scene.simulation;
    simulation.rule = options.rule.unwrap_or(Rule::Exact);
    simulation.frame_time = options.frame_time.unwrap_or(simulation.frame_time);
    simulation.duration = options.duration.unwrap_or(10.0);
    checked(building, path)
}

fn build(file: &File, building: &mut Building) -> Result<(), Malformed> {
    let document = &file.document;
    refuse_unknown(document)?;
    list_unread(document, building);
    let nodes = graph::nodes(document)?;
    let others = document.nodes.len() - nodes.len();
    if others > 0 {
        let reason = format!("{others} of them are not in the scene that is shown first");
        omit(&mut building.report, &building.scene.name, "nodes", reason);
    }
    let has_physics = nodes.iter().any(|it| document.nodes[it.index].extensions.body.is_some());
    let mut meshes = Meshes::new(file);
    let mut bodies = Bodies::new(document, &nodes);
    for (i, node) in nodes.iter().enumerate() {
        appearance::add(document, node, building)?;
        if has_physics {
            bodies.add(i, &mut meshes, building)?;
            if document.nodes[node.index].mesh.is_some() && !bodies.has(i) {
                let reason = match node.pose.scale() == carom::DVec3::ZERO {
                    true => solid::NO_SIZE,
                    false => "is only drawn: it has no collider",
                };
                omit(&mut building.report, &node.path, "mesh", reason);
            }
        } else if let Some(mesh) = document.nodes[node.index].mesh {
            add_mesh(document, node, mesh, &mut meshes, building)?;
        }
    }
    bodies.finish(building);
    Ok(())
}

/// Adds a mesh without physics as a moving sphere or a collider.
fn add_mesh(
    document: &Document,
    node: &Placed,
    mesh: usize,
    meshes: &mut Meshes<'_>,
    building: &mut Building,
) -> Result<(), Malformed> {
    let look = Appearance::of(document, mesh)?;
    let solid = meshes.form(mesh)?.and_then(|form| Solid::of(&form, &node.pose));
    let solid = match solid {
        Ok(solid) => solid,
        Err(reason) => {
            omit(&mut building.report, &node.path, "mesh", reason);
            return Ok(());
        }
    };
    if let Some(reason) = solid.inexact {
        omit(&mut building.report, &node.path, "mesh", reason);
    }
    if let Shape::Sphere { radius } = solid.shape {
        let mut sphere = Sphere::at(solid.position, radius);
        sphere.orientation = solid.rotation;
        (sphere.color, sphere.finish) = (look.color, look.finish);
        building.push_sphere(sphere, node);
        return Ok(());
    }
    let is_rectangle = matches!(solid.shape, Shape::Rectangle { .. });
    let collider = |solid: &Solid| {
        let mut collider = Collider::new(solid.shape.clone());
        (collider.position, collider.rotation) = (solid.position, solid.rotation);
        (collider.color, collider.finish) = (look.color, look.finish);
        collider
    };
    building.push_collider(collider(&solid), node);
    if is_rectangle && look.double_sided {
        let back = Collider { visible: false, ..collider(&solid.back()) };
        building.push_collider(back, node);
    }
    Ok(())
}

/// Refuses a file that requires an extension which is not supported.
fn refuse_unknown(document: &Document) -> Result<(), Malformed> {
    for (i, name) in document.extensions_required.iter().enumerate() {
        let is_look = ["KHR_materials_", "KHR_texture_", "EXT_texture_"];
        let is_read = extensions::READ.contains(&name.as_str());
        if !is_read && !is_look.iter().any(|it| name.starts_with(it)) {
            let place = format!("extensionsRequired[{i}]");
            return Err(Malformed::at(place, format!("{} is not read", plain_name(name))));
        }
    }
    Ok(())
}

/// Reports the unsupported parts of a file.
fn list_unread(document: &Document, building: &mut Building) {
    let Building { scene, report, .. } = building;
    for name in &document.extensions_used {
        if !extensions::READ.contains(&name.as_str()) {
            omit(report, &scene.name, &plain_name(name), "is not read");
        }
    }
    let mut list = |is_there: bool, component: &str, reason: &str| {
        if is_there {
            omit(report, &scene.name, component, reason);
        }
    };
    let reason = "are not read: the scene begins with the nodes as they are";
    list(!document.animations.is_empty(), "animations", reason);
    list(!document.skins.is_empty(), "skins", "have no counterpart");
    list(
        !document.textures.is_empty(),
        "textures",
        "are not read: materials have their plain colours",
    );
    let primitives = || document.meshes.iter().flat_map(|mesh| &mesh.primitives);
    list(primitives().any(|it| !it.targets.is_empty()), "morph targets", "have no counterpart");
    list(document.scenes.len() > 1, "scenes", "only the one that is shown first is read");
}

fn checked(building: Building, path: &Path) -> Result<Imported, ImportError> {
    let Building { mut scene, places, mut report } = building;
    let refused = match made_runnable(&mut scene, &mut report) {
        Ok(()) => return Ok(Imported { scene, omissions: report }),
        Err(refused) => refused,
    };
    if let SceneError::Invalid(fault) = &refused {
        let part = match fault.field.find(']') {
            Some(end) => &fault.field[..=end],
            None => fault.field.split('.').next().unwrap_or_default(),
        };
        if let Some(place) = places.get(part) {
            let problem = format!("{}: {}", fault.field, fault.problem);
            return Err(Malformed::at(place.clone(), problem).in_file(path));
        }
    }
    Err(ImportError::Scene { path: path.to_path_buf(), source: Box::new(refused) })
}
