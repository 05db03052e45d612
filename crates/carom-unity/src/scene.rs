//! Imports a scene of Unity: the stages in order.

use std::collections::BTreeMap;
use std::path::Path;

use carom_scene::SceneError;
use carom_scene::import::{Omission, made_runnable, omit, plain_name};
use carom_scene::scene::{Rule, Scene};

use crate::build::Building;
use crate::class;
use crate::document::Document;
use crate::error::{ImportError, Place};
use crate::graph::{self, Node};
use crate::mapping::Mapping;
use crate::parts::Parts;
use crate::physics::Physics;
use crate::prefab::Loader;
use crate::project::Project;

/// Properties that a scene of Unity does not state.
#[derive(Debug, Clone)]
pub struct Options {
    /// Meanings of the fields of scripts.
    pub mapping: Mapping,
    /// Rule; the default is `discrete` for spheres that scripts move, as in the course, and `exact`
    /// for others.
    pub rule: Option<Rule>,
    /// Length of a frame \[s\]; the default is the project's fixed time step, or 0.02.
    pub frame_time: Option<f64>,
    /// Duration \[s\]; the default is 10.
    pub duration: Option<f64>,
}

impl Default for Options {
    fn default() -> Self {
        Self { mapping: Mapping::course(), rule: None, frame_time: None, duration: None }
    }
}

/// An imported scene.
#[derive(Debug)]
pub struct Imported {
    /// The scene, which is valid.
    pub scene: Scene,
    /// Parts that were ignored, replaced or not understood.
    pub omissions: Vec<Omission>,
}

/// Imports a scene of `project`.
///
/// # Errors
/// [`ImportError`] if a file cannot be read or is broken, or if the scene is invalid.
pub fn import(path: &Path, project: &Project, options: &Options) -> Result<Imported, ImportError> {
    let whole = path.canonicalize();
    let whole =
        whole.map_err(|source| ImportError::Unreadable { path: path.to_path_buf(), source })?;
    let mut loader = Loader::new(project);
    let objects = loader.objects(&whole)?;
    let mut report = std::mem::take(&mut loader.report);
    list_settings(&objects, &whole, &mut report);
    let nodes = active(graph::nodes(&objects, &mut report)?, &mut report);
    let parts: Vec<_> = nodes
        .iter()
        .map(|node| Parts::of(node, &objects, &options.mapping, project, &mut report))
        .collect();

    let name = plain_name(&whole.file_stem().unwrap_or_default().to_string_lossy());
    let mut building = Building::new(&name, project, report);
    let mut physics = Physics::default();
    let moves = Moves::of(&parts);
    for (node, parts) in nodes.iter().zip(&parts) {
        building.add(node, parts)?;
        let is_scripted = parts.scripts.iter().any(|it| it.kind.collider.is_some());
        match parts.colliders.first() {
            Some(collider) if is_scripted => {
                let reason = "the script of the object stands for it";
                omit(&mut building.report, &node.path, &collider.class_name, reason);
            }
            Some(collider) if moves.by_scripts && !moves.by_unity => {
                let reason = "spheres that scripts move pass colliders without a script";
                omit(&mut building.report, &node.path, &collider.class_name, reason);
            }
            Some(_) => physics.add(node, parts, &mut building)?,
            None => list_drawn(node, parts, is_scripted, &mut building.report),
        }
    }
    physics.finish(&mut building)?;
    building.finish();
    simulate(&mut building.scene, moves, options, project)?;
    let origin = whole.file_name().unwrap_or_default().to_string_lossy();
    building.scene.origin = plain_name(&format!("Unity scene {origin}"));
    checked(building, path)
}

/// Whether scripts or Unity's own physics move spheres.
#[derive(Clone, Copy)]
struct Moves {
    by_scripts: bool,
    by_unity: bool,
}

impl Moves {
    fn of(parts: &[Parts<'_>]) -> Self {
        let mut kinds = parts.iter().flat_map(|it| &it.scripts).map(|it| it.kind);
        Self {
            by_scripts: kinds.any(|it| it.emitter.is_some() || it.sphere.is_some()),
            by_unity: parts.iter().any(Parts::is_moving_sphere),
        }
    }
}

/// Returns the active nodes; reports the others.
fn active(nodes: Vec<Node>, report: &mut Vec<Omission>) -> Vec<Node> {
    let (active, inactive): (Vec<_>, Vec<_>) = nodes.into_iter().partition(|node| node.active);
    for node in inactive {
        omit(report, &node.path, "game object", "is inactive, or hangs on one that is");
    }
    active
}

/// Reports settings such as lighting and navigation.
fn list_settings(objects: &[Document], path: &Path, report: &mut Vec<Omission>) {
    let file = path.file_name().unwrap_or_default().to_string_lossy();
    for object in objects.iter().filter(|it| class::SETTINGS.contains(&it.class)) {
        omit(report, &file, &object.class_name, "has no counterpart");
    }
}

/// Reports meshes that are only drawn.
fn list_drawn(node: &Node, parts: &Parts<'_>, is_scripted: bool, report: &mut Vec<Omission>) {
    if parts.rigid_body.is_some() {
        omit(report, &node.path, "Rigidbody", "it has no collider");
    }
    if parts.mesh.or(parts.renderer).is_some() && !is_scripted {
        omit(report, &node.path, "mesh", "is only drawn: it has no collider");
    }
}

/// Sets rule, frame time and duration of the scene.
fn simulate(
    scene: &mut Scene,
    moves: Moves,
    options: &Options,
    project: &Project,
) -> Result<(), ImportError> {
    let by_scripts = if moves.by_scripts { Rule::Discrete } else { Rule::Exact };
    let simulation = &mut scene.simulation;
    simulation.rule = options.rule.unwrap_or(by_scripts);
    simulation.frame_time = match options.frame_time {
        Some(frame_time) => frame_time,
        None => fixed_time_step(project)?.unwrap_or(0.02),
    };
    simulation.duration = options.duration.unwrap_or(10.0);
    simulation.spheres_collide = moves.by_unity || !moves.by_scripts;
    Ok(())
}

/// Fixed time step of a project \[s\].
fn fixed_time_step(project: &Project) -> Result<Option<f64>, ImportError> {
    let field = "Fixed Timestep";
    let Some(step) = project.setting("TimeManager.asset", field)? else { return Ok(None) };
    // Since Unity 6 the time is a number of ticks with their rate per second.
    let ticks = step.get("m_Count").zip(step.get("m_Rate"));
    let step = match ticks {
        None => step.number(field)?,
        Some((count, rate)) => {
            let [seconds, ticks] = rate.numbers("m_Rate", ["m_Denominator", "m_Numerator"])?;
            carom_scene::import::shortened([count.number("m_Count")? * seconds / ticks])[0]
        }
    };
    Ok(Some(step))
}

/// Returns the scene if it is valid.
fn checked(building: Building<'_>, path: &Path) -> Result<Imported, ImportError> {
    let Building { mut scene, places, mut report, .. } = building;
    match made_runnable(&mut scene, &mut report) {
        Ok(()) => Ok(Imported { scene, omissions: report }),
        Err(error) => Err(at_place(error, &places, path)),
    }
}

/// Converts an error of the scene to one at the line of Unity's file, if that is known.
fn at_place(error: SceneError, places: &BTreeMap<String, Place>, path: &Path) -> ImportError {
    if let SceneError::Invalid(fault) = &error {
        let part = match fault.field.find(']') {
            Some(end) => &fault.field[..=end],
            None => fault.field.split('.').next().unwrap_or_default(),
        };
        if let Some(place) = places.get(part) {
            return place.malformed(format!("{}: {}", fault.field, fault.problem));
        }
    }
    ImportError::Scene { path: path.to_path_buf(), source: Box::new(error) }
}
