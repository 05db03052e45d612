//! Tables of scene files: one type per table.
//!
//! The doc comments here are the descriptions in the JSON Schema that editors show.

mod collider;
mod emitter;
mod finish;
mod force;
mod generator;
mod look;
mod rotation;
mod simulation;
mod sphere;
mod spring;
pub(crate) mod values;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use collider::{Collider, Shape, Side};
pub use emitter::Emitter;
pub use finish::Finish;
pub use force::Force;
pub use generator::{Generator, Lattice, Ring, Row, Stacking, StaggeredRows};
pub use look::{Camera, Colors, DensityColor, Sun};
pub use simulation::{
    Bisect, Boundary, CombineRule, Contact, Discrete, Exact, ImpactLaw, Integrator, Rule,
    Simulation, WindBack, Zones,
};
pub use sphere::Sphere;
pub use spring::Spring;
pub use values::{Color, Quaternion, Vector};

/// A Carom scene: spheres, forces, colliders, camera and light. Right-handed frame, y up, SI units.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// Short name for the command line; by default that of the file without its ending.
    #[serde(default)]
    pub name: String,
    /// Name for people; the scene can also be found by it.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub title: String,
    /// Description of the scene in a sentence or two.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub description: String,
    /// Origin of the scene.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub origin: String,
    /// Settings of the simulation.
    #[serde(default)]
    pub simulation: Simulation,
    /// Forces on every sphere; they are summed.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub forces: Vec<Force>,
    /// Single spheres.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub spheres: Vec<Sphere>,
    /// Places for many spheres or colliders, which come after the single ones.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub generators: Vec<Generator>,
    /// Springs and threads, between spheres or from one to a fixed point.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub springs: Vec<Spring>,
    /// Fixed shapes, in the order in which the rule `discrete` tests them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub colliders: Vec<Collider>,
    /// Sources of spheres.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub emitters: Vec<Emitter>,
    /// The camera; where it is missing, a camera that shows the whole scene.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub camera: Option<Camera>,
    /// The light.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sun: Option<Sun>,
    /// Colours of spheres and colliders without their own, and of the background.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub colors: Option<Colors>,
}

impl Scene {
    /// Creates an empty scene of this name, to be filled by code.
    pub fn new(name: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            title: String::new(),
            description: String::new(),
            origin: String::new(),
            simulation: Simulation::default(),
            forces: Vec::new(),
            spheres: Vec::new(),
            generators: Vec::new(),
            springs: Vec::new(),
            colliders: Vec::new(),
            emitters: Vec::new(),
            camera: None,
            sun: None,
            colors: None,
        }
    }
}
