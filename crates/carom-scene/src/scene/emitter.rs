//! Sources of spheres.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::rotation;
use super::sphere::Sphere;
use super::values::{Quaternion, Vector, unturned};

/// Emits a sphere at the times 0, period, 2 period, ..., `count` in all.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Emitter {
    /// Name of the emitter.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub name: String,
    /// Position at which spheres appear, in m.
    #[serde(default)]
    pub position: Vector,
    /// Rotation of the emitter, and of the velocity of its spheres.
    #[schemars(with = "rotation::Rotation")]
    #[serde(default = "unturned", deserialize_with = "rotation::read")]
    pub rotation: Quaternion,
    /// Time between two spheres, in s, > 0.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub period: f64,
    /// Most spheres of this emitter at one time: the oldest is removed to make place for a new one;
    /// no limit where it is missing.
    #[schemars(range(min = 1))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_spheres: Option<u32>,
    /// Most spheres that it emits in all, counting those left out; no limit where it is missing.
    #[schemars(range(min = 1))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub count: Option<u32>,
    /// Whether a sphere that would overlap another one is left out; where it is missing, under the
    /// rule `contact` only.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub needs_room: Option<bool>,
    /// The emitted sphere.
    pub sphere: Sphere,
}
