//! Places for many spheres.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::sphere::Sphere;
use super::values::Vector;

/// Places for many spheres.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Generator {
    /// Spheres one after the other along a line.
    Row {
        /// How many, >= 1.
        #[schemars(range(min = 1))]
        count: u32,
        /// Centre of the first, in m.
        start: Vector,
        /// From each centre to the next, in m.
        step: Vector,
        /// What they have in common.
        sphere: Sphere,
    },
    /// Spheres on a box-shaped lattice; x runs fastest, then y, then z.
    Lattice {
        /// How many along x, y and z, each >= 1.
        counts: [u32; 3],
        /// Centre of the first, in m.
        start: Vector,
        /// Distance of neighbours along x, y and z, in m.
        spacing: Vector,
        /// What they have in common.
        sphere: Sphere,
    },
    /// Spheres scattered in a box, none overlapping another sphere or a collider.
    Random {
        /// How many, >= 1.
        #[schemars(range(min = 1))]
        count: u32,
        /// Lower corner of the box that holds the whole spheres, in m.
        min: Vector,
        /// Upper corner of the box, in m.
        max: Vector,
        /// The same seed gives the same scene.
        seed: u32,
        /// Speed, in m/s, >= 0, in a random direction, on top of the common velocity.
        #[schemars(range(min = 0.0))]
        #[serde(default)]
        speed: f64,
        /// Smallest and largest radius, in m, evenly distributed, instead of the common one.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        radius_range: Option<[f64; 2]>,
        /// What they have in common.
        sphere: Sphere,
    },
}

impl Generator {
    /// Name of its kind, as it is written.
    pub(crate) fn kind(&self) -> &'static str {
        match self {
            Self::Row { .. } => "row",
            Self::Lattice { .. } => "lattice",
            Self::Random { .. } => "random",
        }
    }

    /// How many spheres it makes.
    pub fn count(&self) -> u64 {
        match self {
            Self::Row { count, .. } | Self::Random { count, .. } => (*count).into(),
            Self::Lattice { counts, .. } => product(counts),
        }
    }

    /// What its spheres have in common.
    pub fn template(&self) -> &Sphere {
        match self {
            Self::Row { sphere, .. }
            | Self::Lattice { sphere, .. }
            | Self::Random { sphere, .. } => sphere,
        }
    }
}

fn product(counts: &[u32; 3]) -> u64 {
    counts.iter().fold(1, |total, &count| total.saturating_mul(count.into()))
}
