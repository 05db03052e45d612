//! The extensions `KHR_implicit_shapes` and `KHR_physics_rigid_bodies` (both drafts of Khronos).

use serde::de::IgnoredAny;
use serde::{Deserialize, Serialize};

/// Shapes of the file.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct Shapes {
    pub shapes: Vec<Shape>,
}

/// A shape at the origin of a node.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct Shape {
    #[serde(rename = "type")]
    pub kind: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sphere: Option<SphereShape>,
    #[serde(rename = "box", skip_serializing_if = "Option::is_none")]
    pub solid_box: Option<BoxShape>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plane: Option<PlaneShape>,
}

/// A sphere.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct SphereShape {
    pub radius: f64,
}

impl Default for SphereShape {
    fn default() -> Self {
        Self { radius: 0.5 }
    }
}

/// A box.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct BoxShape {
    pub size: [f64; 3],
}

impl Default for BoxShape {
    fn default() -> Self {
        Self { size: [1.0; 3] }
    }
}

/// A plane that faces local +y; infinite if it has no sizes.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(crate) struct PlaneShape {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub size_x: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub size_z: Option<f64>,
    #[serde(skip_serializing_if = "is_false")]
    pub double_sided: bool,
}

/// Common data of the bodies of a file.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(crate) struct RigidBodies {
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub physics_materials: Vec<PhysicsMaterial>,
    #[serde(skip_serializing)]
    pub physics_joints: Vec<IgnoredAny>,
}

/// Restitution and friction of a surface.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(crate) struct PhysicsMaterial {
    pub static_friction: f64,
    pub dynamic_friction: f64,
    pub restitution: f64,
    pub friction_combine: Combine,
    pub restitution_combine: Combine,
}

impl Default for PhysicsMaterial {
    fn default() -> Self {
        Self {
            static_friction: 0.6,
            dynamic_friction: 0.6,
            restitution: 0.0,
            friction_combine: Combine::Average,
            restitution_combine: Combine::Average,
        }
    }
}

/// How values of two surfaces combine. If the surfaces differ, the first mode in this list counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Combine {
    Average,
    Minimum,
    Maximum,
    Multiply,
}

/// Physics of a node.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct NodeBody {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub motion: Option<Motion>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub collider: Option<Collider>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub trigger: Option<Collider>,
    #[serde(skip_serializing)]
    pub joint: Option<IgnoredAny>,
}

/// Motion of a body at the start; velocities are in the coordinates of the node.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(crate) struct Motion {
    #[serde(skip_serializing_if = "is_false")]
    pub is_kinematic: bool,
    /// Mass \[kg\]; 0 means infinite.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mass: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub center_of_mass: Option<[f64; 3]>,
    /// Moments of inertia \[kg m²\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inertia_diagonal: Option<[f64; 3]>,
    /// Velocity \[m/s\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub linear_velocity: Option<[f64; 3]>,
    /// Angular velocity \[rad/s\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub angular_velocity: Option<[f64; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gravity_factor: Option<f64>,
}

/// Collider of a node.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(crate) struct Collider {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub geometry: Option<Geometry>,
    /// Number of the shape, in files of a draft of the extension without `geometry`.
    #[serde(skip_serializing)]
    pub shape: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub physics_material: Option<usize>,
    #[serde(skip_serializing)]
    pub collision_filter: Option<usize>,
    #[serde(skip_serializing)]
    pub nodes: Vec<usize>,
}

/// Geometry: the index of a shape, of a mesh, or of a node with a mesh.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct Geometry {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shape: Option<usize>,
    #[serde(skip_serializing)]
    pub mesh: Option<usize>,
    #[serde(skip_serializing)]
    pub node: Option<usize>,
}

fn is_false(value: &bool) -> bool {
    !*value
}
