//! What spheres bounce off.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::values::{Color, Quaternion, Vector, one, unturned};

/// A fixed shape that spheres bounce off.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Collider {
    /// What it is called.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub name: String,
    /// Its form.
    pub shape: Shape,
    /// Where its centre is, in m.
    #[serde(default)]
    pub position: Vector,
    /// How it is turned.
    #[serde(default = "unturned")]
    pub rotation: Quaternion,
    /// How fast its centre moves, in m/s.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub velocity: Vector,
    /// How fast it turns about its centre, along the axis, in rad/s.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub angular_velocity: Vector,
    /// Coefficient of restitution in [0, 1].
    #[schemars(range(min = 0.0, max = 1.0))]
    #[serde(default = "one")]
    pub restitution: f64,
    /// A trigger reports contact and deflects nothing.
    #[serde(default, skip_serializing_if = "is_false")]
    pub trigger: bool,
    /// Whether it is drawn.
    #[serde(default = "yes", skip_serializing_if = "is_true")]
    pub visible: bool,
    /// Its colour; the scene's own for surfaces where it is missing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub color: Option<Color>,
}

/// Form of a collider in its own frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Shape {
    /// A sphere.
    Sphere {
        /// In m, > 0
        #[schemars(extend("exclusiveMinimum" = 0.0))]
        radius: f64,
    },
    /// A rectangle in its local xz plane that faces local +y; from behind spheres pass it.
    Rectangle {
        /// Full length along local x, in m, > 0.
        #[schemars(extend("exclusiveMinimum" = 0.0))]
        size_x: f64,
        /// Full length along local z, in m, > 0.
        #[schemars(extend("exclusiveMinimum" = 0.0))]
        size_z: f64,
    },
    /// Everything below the local xz plane.
    HalfSpace,
    /// A box of six rectangles that face outward.
    Box {
        /// Full lengths along local x, y, z, in m, each > 0.
        size: Vector,
    },
}

fn yes() -> bool {
    true
}

fn is_true(value: &bool) -> bool {
    *value
}

fn is_false(value: &bool) -> bool {
    !*value
}

fn is_zero(vector: &Vector) -> bool {
    *vector == [0.0; 3]
}
