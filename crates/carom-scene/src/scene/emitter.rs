//! Sources of spheres.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::rotation;
use super::sphere::Sphere;
use super::values::{Quaternion, Vector, unturned};

/// A source of spheres: one at the times 0, period, 2 period, ...
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Emitter {
    /// Name, for reports.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub name: String,
    /// Position at which spheres appear, in m.
    #[serde(default)]
    pub position: Vector,
    /// Rotation of the emitter; it turns the velocity of its spheres, too.
    #[schemars(with = "rotation::Rotation")]
    #[serde(default = "unturned", deserialize_with = "rotation::read")]
    pub rotation: Quaternion,
    /// Time between two spheres, in s, > 0.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub period: f64,
    /// Most of its spheres at one time; the oldest goes before another comes. By default no limit.
    #[schemars(range(min = 1))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_spheres: Option<u32>,
    /// Spheres in all, those left out included. By default no end.
    #[schemars(range(min = 1))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub count: Option<u32>,
    /// Whether a sphere that would overlap another one is left out. By default only under the rule `contact`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub needs_room: Option<bool>,
    /// The sphere that it emits.
    pub sphere: Sphere,
}
