//! How a scene is seen: camera, light, colours.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::rotation;
use super::values::{Color, Quaternion, Vector, one, unturned};

/// A camera. It looks along its local -z.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(try_from = "WrittenCamera")]
#[schemars(with = "WrittenCamera")]
pub struct Camera {
    /// Position, in m.
    pub position: Vector,
    /// Rotation of the camera.
    pub rotation: Quaternion,
    /// Vertical field of view, in degrees, in (0, 180).
    pub vertical_fov_degrees: f64,
    /// Nearest distance drawn, in m, > 0.
    pub near: f64,
    /// Farthest distance drawn, in m, > near.
    pub far: f64,
}

/// A camera. It looks along its local -z.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Camera")]
struct WrittenCamera {
    /// Position, in m.
    position: Vector,
    /// Rotation. Give this or `look_at`.
    #[schemars(with = "rotation::Rotation")]
    #[serde(default, deserialize_with = "rotation::read_some")]
    rotation: Option<Quaternion>,
    /// Point to look at, in m; +y is up in the picture.
    look_at: Option<Vector>,
    /// Vertical field of view, in degrees, in (0, 180).
    #[schemars(extend("exclusiveMinimum" = 0.0, "exclusiveMaximum" = 180.0))]
    #[serde(default = "thirty_five")]
    vertical_fov_degrees: f64,
    /// Nearest distance drawn, in m, > 0.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    #[serde(default = "near")]
    near: f64,
    /// Farthest distance drawn, in m, > near.
    #[serde(default = "far")]
    far: f64,
}

impl TryFrom<WrittenCamera> for Camera {
    type Error = String;

    fn try_from(written: WrittenCamera) -> Result<Self, String> {
        let WrittenCamera { position, rotation, look_at, vertical_fov_degrees, near, far } =
            written;
        let rotation = match (rotation, look_at) {
            (Some(_), Some(_)) => return Err("takes `rotation` or `look_at`, not both".to_owned()),
            (Some(rotation), None) => rotation,
            (None, Some(target)) => rotation::looking_at(position, target)?,
            (None, None) => unturned(),
        };
        Ok(Self { position, rotation, vertical_fov_degrees, near, far })
    }
}

fn thirty_five() -> f64 {
    35.0
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
    #[schemars(with = "rotation::Rotation")]
    #[serde(deserialize_with = "rotation::read")]
    pub rotation: Quaternion,
    /// Colour of the light.
    pub color: Color,
    /// Brightness, >= 0; 1 is plain daylight.
    #[schemars(range(min = 0.0))]
    #[serde(default = "one")]
    pub intensity: f64,
}

/// Colours of things without their own colour.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Colors {
    /// Colour of the background.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub background: Option<Color>,
    /// Colour of colliders.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub colliders: Option<Color>,
    /// Colour of spheres of other densities.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spheres: Option<Color>,
    /// Colours of spheres by density.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub densities: Vec<DensityColor>,
}

/// The colour of spheres of one density.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DensityColor {
    /// Density, in kg/m³, > 0.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub density: f64,
    /// Colour of these spheres.
    pub color: Color,
}
