//! What acts on spheres.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::values::Vector;

/// A force on every sphere.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Force {
    /// The same force on every sphere, whatever its mass.
    Constant {
        /// In N.
        force: Vector,
    },
    /// The same acceleration for every sphere.
    Gravity {
        /// In m/s².
        acceleration: Vector,
    },
    /// Drag against the velocity and proportional to it.
    ViscousDrag {
        /// In kg/s, >= 0
        #[schemars(range(min = 0.0))]
        coefficient: f64,
    },
}
