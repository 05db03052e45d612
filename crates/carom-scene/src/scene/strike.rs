//! Blows of a cue.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::values::is_default;

/// The blow of a cue on a sphere, at one instant and one point, without loss of energy.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Strike {
    /// Speed of the cue, in m/s, >= 0.
    #[schemars(range(min = 0.0))]
    pub speed: f64,
    /// Direction of the cue from above, in degrees from +x towards -z, counterclockwise. By default 0.
    #[serde(default, skip_serializing_if = "is_default")]
    pub azimuth_degrees: f64,
    /// Angle by which the cue points down, in degrees, in [0, 90]. By default 0.
    #[schemars(range(min = 0.0, max = 90.0))]
    #[serde(default, skip_serializing_if = "is_default")]
    pub elevation_degrees: f64,
    /// Offset of the cue from the centre to the right and up, as seen along it, in parts of the radius; its size is
    /// below 1. By default none.
    #[serde(default, skip_serializing_if = "is_default")]
    pub offset: [f64; 2],
    /// Mass of the cue, in kg, > 0. By default 0.567 kg, 20 ounces.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    #[serde(default = "cue_mass", skip_serializing_if = "is_cue_mass")]
    pub cue_mass: f64,
}

impl Strike {
    /// Creates a level strike at the middle along +x with a speed \[m/s\].
    pub fn new(speed: f64) -> Self {
        Self {
            speed,
            azimuth_degrees: 0.0,
            elevation_degrees: 0.0,
            offset: [0.0; 2],
            cue_mass: cue_mass(),
        }
    }
}

fn cue_mass() -> f64 {
    0.567
}

fn is_cue_mass(mass: &f64) -> bool {
    *mass == cue_mass()
}
