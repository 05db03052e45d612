//! What acts on spheres.

use carom::MutualGravity;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::values::{Vector, is_default};

/// A force on every sphere.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Force {
    /// The same force on every sphere, whatever its mass.
    Constant {
        /// Force, in N.
        force: Vector,
    },
    /// The same acceleration for every sphere.
    Gravity {
        /// Acceleration, in m/s².
        acceleration: Vector,
    },
    /// Drag against the velocity and proportional to it.
    ViscousDrag {
        /// Drag coefficient, in kg/s, >= 0.
        #[schemars(range(min = 0.0))]
        coefficient: f64,
    },
    /// Gravity of a fixed point mass, such as a sun.
    PointAttractor {
        /// Position of the point, in m.
        #[serde(default)]
        position: Vector,
        /// Gravitational parameter G M, in m³/s². A negative one repels.
        gravitational_parameter: f64,
        /// Softening length, in m, >= 0. At smaller distances the force falls to zero. By default 0.
        #[schemars(range(min = 0.0))]
        #[serde(default, skip_serializing_if = "is_default")]
        softening: f64,
    },
    /// Gravity between all pairs of spheres.
    MutualGravity {
        /// Gravitational constant, in m³/(kg s²). A negative one repels.
        #[serde(default = "newton")]
        constant: f64,
        /// Softening length, in m, >= 0. At smaller distances the force falls to zero. By default 0.
        #[schemars(range(min = 0.0))]
        #[serde(default, skip_serializing_if = "is_default")]
        softening: f64,
        /// Accuracy above a thousand spheres, in [0, 1]: a cube of spheres counts as one if its edge divided by its
        /// distance is smaller. With 0 every pair is summed.
        #[schemars(range(min = 0.0, max = 1.0))]
        #[serde(default = "half")]
        opening_angle: f64,
    },
    /// Viscous drag in a wind that is the same everywhere.
    Wind {
        /// Velocity of the air, in m/s.
        velocity: Vector,
        /// Drag coefficient, in kg/s, >= 0.
        #[schemars(range(min = 0.0))]
        coefficient: f64,
    },
    /// Viscous drag in air that circles an axis.
    Vortex {
        /// A point of the axis, in m.
        #[serde(default)]
        position: Vector,
        /// Direction of the axis, of any length but zero. The air circles it by the right-hand rule.
        #[serde(default = "up")]
        axis: Vector,
        /// Circulation, in m²/s.
        circulation: f64,
        /// Distance from the axis at which the air is fastest, in m, > 0.
        #[schemars(extend("exclusiveMinimum" = 0.0))]
        core_radius: f64,
        /// Drag coefficient, in kg/s, >= 0.
        #[schemars(range(min = 0.0))]
        coefficient: f64,
    },
    /// Drag of a medium, proportional to the square of the velocity.
    QuadraticDrag {
        /// Density of the medium, in kg/m³, >= 0: 1.2 for air, 1000 for water.
        #[schemars(range(min = 0.0))]
        density: f64,
        /// Drag coefficient, >= 0.
        #[schemars(range(min = 0.0))]
        #[serde(default = "newtons_drag")]
        drag_coefficient: f64,
        /// Dynamic viscosity of the medium, in Pa s, >= 0. With it, the drag coefficient of slow spheres depends on the
        /// Reynolds number.
        #[schemars(range(min = 0.0))]
        #[serde(default, skip_serializing_if = "is_default")]
        viscosity: f64,
        /// Velocity of the medium, in m/s. By default at rest.
        #[serde(default, skip_serializing_if = "is_default")]
        wind: Vector,
    },
    /// Buoyancy in a fluid with a level surface.
    Buoyancy {
        /// Density of the fluid, in kg/m³, >= 0.
        #[schemars(range(min = 0.0))]
        density: f64,
        /// Height of the surface above the origin, in m.
        #[serde(default)]
        surface_height: f64,
        /// Acceleration of gravity in the fluid, in m/s², not zero. It points down.
        #[serde(default = "earth")]
        gravity: Vector,
    },
}

impl Force {
    /// Returns whether it has a potential: it does no work along a closed path.
    pub fn has_potential(&self) -> bool {
        match self {
            Self::Constant { .. }
            | Self::Gravity { .. }
            | Self::PointAttractor { .. }
            | Self::MutualGravity { .. }
            | Self::Buoyancy { .. } => true,
            Self::ViscousDrag { .. }
            | Self::Wind { .. }
            | Self::Vortex { .. }
            | Self::QuadraticDrag { .. } => false,
        }
    }

    /// Name of its kind, as it is written.
    pub(crate) fn kind(&self) -> &'static str {
        match self {
            Self::Constant { .. } => "constant",
            Self::Gravity { .. } => "gravity",
            Self::ViscousDrag { .. } => "viscous-drag",
            Self::PointAttractor { .. } => "point-attractor",
            Self::MutualGravity { .. } => "mutual-gravity",
            Self::Wind { .. } => "wind",
            Self::Vortex { .. } => "vortex",
            Self::QuadraticDrag { .. } => "quadratic-drag",
            Self::Buoyancy { .. } => "buoyancy",
        }
    }
}

fn newton() -> f64 {
    MutualGravity::NEWTON
}

fn half() -> f64 {
    0.5
}

fn newtons_drag() -> f64 {
    0.44
}

fn up() -> Vector {
    [0.0, 1.0, 0.0]
}

fn earth() -> Vector {
    [0.0, -9.81, 0.0]
}
