//! What a scene file says: one type per table of the file.
//!
//! The doc comments here are the descriptions in the JSON Schema that editors show.

mod collider;
mod emitter;
mod finish;
mod force;
mod generator;
mod look;
mod material;
mod mesh;
mod motion;
mod rotation;
mod scale;
mod simulation;
mod sphere;
mod spring;
mod strike;
mod suggestion;
mod track;
pub(crate) mod values;

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use collider::{Collider, End, Shape, Side};
pub use emitter::Emitter;
pub use finish::Finish;
pub use force::Force;
pub use generator::{DenseFluid, Generator, Lattice, Ring, Row, Stacking, StaggeredRows};
pub use look::{Camera, Colors, DensityColor, Sun};
pub use material::{Material, MaterialPair, RestitutionLaw};
pub use mesh::{HeightField, Mesh};
pub use motion::Motion;
pub use simulation::{
    Bisect, Boundary, CombineRule, Contact, Discrete, Exact, ImpactLaw, Integrator, PairPotential,
    Rule, Simulation, Thermostat, WindBack, Zones,
};
pub use sphere::Sphere;
pub use spring::Spring;
pub use strike::Strike;
pub use suggestion::Try;
pub use track::{Piece, Track};
pub use values::{Color, Quaternion, Vector};

/// A Carom scene: spheres, forces, surfaces, and how the scene looks. The coordinate system is right-handed, y is up,
/// units are SI.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// Short name, as typed on the command line. By default that of the file without its ending.
    #[serde(default)]
    pub name: String,
    /// Name that people see; the scene is also found by it.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub title: String,
    /// What the scene shows, in a sentence or two.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub description: String,
    /// Source of the scene.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub origin: String,
    /// Up to three things to try.
    #[serde(default, rename = "try", skip_serializing_if = "Vec::is_empty")]
    pub tries: Vec<Try>,
    /// Rule, frame and other settings of the simulation.
    #[serde(default)]
    pub simulation: Simulation,
    /// Forces on every sphere; they add up.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub forces: Vec<Force>,
    /// Materials by name, for spheres and colliders.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub materials: BTreeMap<String, Material>,
    /// Pairs of materials whose contacts have coefficients of their own.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub material_pairs: Vec<MaterialPair>,
    /// Single spheres.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub spheres: Vec<Sphere>,
    /// Places for many spheres or colliders. They come after the single ones.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub generators: Vec<Generator>,
    /// Springs and threads, between spheres or from one to a fixed point.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub springs: Vec<Spring>,
    /// Surfaces, in the order in which the rule `discrete` tests them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub colliders: Vec<Collider>,
    /// Sources of spheres.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub emitters: Vec<Emitter>,
    /// Camera. By default one that shows the whole scene.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub camera: Option<Camera>,
    /// The light.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sun: Option<Sun>,
    /// Colours of things without their own colour.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub colors: Option<Colors>,
}

impl Scene {
    /// An empty scene of this name, to be filled by code.
    pub fn new(name: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            title: String::new(),
            description: String::new(),
            origin: String::new(),
            tries: Vec::new(),
            simulation: Simulation::default(),
            forces: Vec::new(),
            materials: BTreeMap::new(),
            material_pairs: Vec::new(),
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
