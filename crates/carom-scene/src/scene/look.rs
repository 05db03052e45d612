//! How a scene is seen: camera, light, colours.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::values::{Color, Quaternion, Vector, one, unturned};

/// Where to look from. The camera looks along its local -z.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Camera {
    /// In m.
    pub position: Vector,
    /// Rotation of the camera.
    #[serde(default = "unturned")]
    pub rotation: Quaternion,
    /// Vertical field of view, in degrees, in (0, 180).
    #[schemars(extend("exclusiveMinimum" = 0.0, "exclusiveMaximum" = 180.0))]
    #[serde(default = "sixty")]
    pub vertical_fov_degrees: f64,
    /// Nearest distance drawn, in m, > 0.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    #[serde(default = "near")]
    pub near: f64,
    /// Farthest distance drawn, in m, > near.
    #[serde(default = "far")]
    pub far: f64,
}

fn sixty() -> f64 {
    60.0
}

fn near() -> f64 {
    0.3
}

fn far() -> f64 {
    1000.0
}

/// The light. It travels along its local -z.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Sun {
    /// Rotation of the light.
    pub rotation: Quaternion,
    /// Colour of the light.
    pub color: Color,
    /// Brightness, >= 0; 1 is plain daylight.
    #[schemars(range(min = 0.0))]
    #[serde(default = "one")]
    pub intensity: f64,
}

/// Colours of what has none of its own.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Colors {
    /// Behind everything.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub background: Option<Color>,
    /// Colliders.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub colliders: Option<Color>,
    /// Spheres whose density is not listed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spheres: Option<Color>,
    /// Spheres by their density.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub densities: Vec<DensityColor>,
}

/// The colour of spheres of one density.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DensityColor {
    /// In kg/m³, > 0
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub density: f64,
    /// Their colour.
    pub color: Color,
}
