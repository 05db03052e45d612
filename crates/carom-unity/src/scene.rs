//! A scene of Unity to a scene of Carom: the stages in order.

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

/// What a scene of Unity does not say.
#[derive(Debug, Clone)]
pub struct Options {
    /// What the fields of scripts mean.
    pub mapping: Mapping,
    /// The step rule; where it is missing `discrete` for spheres that scripts move, as the course does,
    /// `exact` for others.
    pub rule: Option<Rule>,
    /// Length of a frame \[s\]; where it is missing the project's fixed time step, or 0.02.
    pub frame_time: Option<f64>,
    /// Time worth watching \[s\]; 10 where it is missing.
    pub duration: Option<f64>,
}

impl Default for Options {
    fn default() -> Self {
        Self { mapping: Mapping::course(), rule: None, frame_time: None, duration: None }
    }
}

/// A scene that was imported.
#[derive(Debug)]
pub struct Imported {
    /// The scene; it makes a world.
    pub scene: Scene,
    /// What was not understood or has no counterpart.
    pub omissions: Vec<Omission>,
}

/// Imports a scene, the files of `project` around it.
///
/// # Errors
/// Files that cannot be read or are broken, and scenes that make no world.
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

/// What moves spheres.
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

/// The nodes that are active; the others go to the report.
fn active(nodes: Vec<Node>, report: &mut Vec<Omission>) -> Vec<Node> {
    let (active, inactive): (Vec<_>, Vec<_>) = nodes.into_iter().partition(|node| node.active);
    for node in inactive {
        omit(report, &node.path, "game object", "is inactive, or hangs on one that is");
    }
    active
}

/// Lists settings that say how a scene is lit and walked through.
fn list_settings(objects: &[Document], path: &Path, report: &mut Vec<Omission>) {
    let file = path.file_name().unwrap_or_default().to_string_lossy();
    for object in objects.iter().filter(|it| class::SETTINGS.contains(&it.class)) {
        omit(report, &file, &object.class_name, "has no counterpart");
    }
}

/// Lists meshes that are only drawn.
fn list_drawn(node: &Node, parts: &Parts<'_>, is_scripted: bool, report: &mut Vec<Omission>) {
    if parts.rigid_body.is_some() {
        omit(report, &node.path, "Rigidbody", "it has no collider");
    }
    if parts.mesh.or(parts.renderer).is_some() && !is_scripted {
        omit(report, &node.path, "mesh", "is only drawn: it has no collider");
    }
}

/// Sets how the scene is stepped.
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

/// The fixed time step of a project \[s\].
fn fixed_time_step(project: &Project) -> Result<Option<f64>, ImportError> {
    let field = "Fixed Timestep";
    let Some(step) = project.setting("TimeManager.asset", field)? else { return Ok(None) };
    // Since Unity 6 a number of ticks, and how many there are in a second.
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

/// The scene, if it makes a world.
fn checked(building: Building<'_>, path: &Path) -> Result<Imported, ImportError> {
    let Building { mut scene, places, mut report, .. } = building;
    match made_runnable(&mut scene, &mut report) {
        Ok(()) => Ok(Imported { scene, omissions: report }),
        Err(error) => Err(at_place(error, &places, path)),
    }
}

/// A refusal of a scene, at the line of Unity's file where that is known.
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
