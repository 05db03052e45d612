//! Places for many spheres or colliders.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::collider::Collider;
use super::sphere::Sphere;
use super::values::Vector;

/// Places for many spheres or colliders.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Generator {
    /// Spheres or colliders one after the other along a line.
    Row(Box<Row>),
    /// Spheres or colliders on a box-shaped lattice; x runs fastest, then y, then z.
    Lattice(Box<Lattice>),
    /// Rows, each centred on the one before: staggered, in a triangle, or straight. Of spheres, or
    /// of colliders like the pegs of a Galton board.
    StaggeredRows(Box<StaggeredRows>),
    /// Close packing of equal spheres in hexagonal layers, one above the other along +y: in a layer
    /// rows run along x, and every second row is shifted by half a sphere.
    ClosePacking {
        /// How many spheres in a row, layers, and rows in a layer: along x, y and z, each >= 1.
        counts: [u32; 3],
        /// Centre of the first, in m.
        start: Vector,
        /// Distance of the centres of neighbours, in m, > 0; the diameter where it is missing.
        #[schemars(extend("exclusiveMinimum" = 0.0))]
        #[serde(default, skip_serializing_if = "Option::is_none")]
        spacing: Option<f64>,
        /// The order of layers.
        #[serde(default)]
        stacking: Stacking,
        /// What they have in common.
        sphere: Sphere,
    },
    /// Spheres or colliders evenly on a circle.
    Ring(Box<Ring>),
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

/// Places one after the other along a line.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = [{ "required": ["sphere"] }, { "required": ["collider"] }]))]
pub struct Row {
    /// How many, >= 1.
    #[schemars(range(min = 1))]
    pub count: u32,
    /// Centre of the first, in m.
    pub start: Vector,
    /// From each centre to the next, in m.
    pub step: Vector,
    /// What spheres have in common. Give this or `collider`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sphere: Option<Sphere>,
    /// What colliders have in common; its position is an offset, its name gets its number.
    /// Give this or `sphere`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub collider: Option<Collider>,
}

/// Places on a box-shaped lattice; x runs fastest, then y, then z.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = [{ "required": ["sphere"] }, { "required": ["collider"] }]))]
pub struct Lattice {
    /// How many along x, y and z, each >= 1.
    pub counts: [u32; 3],
    /// Centre of the first, in m.
    pub start: Vector,
    /// Distance of neighbours along x, y and z, in m.
    pub spacing: Vector,
    /// What spheres have in common. Give this or `collider`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sphere: Option<Sphere>,
    /// What colliders have in common; its position is an offset, its name gets its numbers along x, y and z.
    /// Give this or `sphere`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub collider: Option<Collider>,
}

/// Places evenly on a circle.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = [{ "required": ["sphere"] }, { "required": ["collider"] }]))]
pub struct Ring {
    /// How many, >= 1.
    #[schemars(range(min = 1))]
    pub count: u32,
    /// Of the circle, in m.
    pub center: Vector,
    /// From the centre of the circle to the places, in m, > 0.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub radius: f64,
    /// Direction about which they go round, by the right-hand rule; of any length but zero. The
    /// first is at the side of +x, or of +y where the axis is nearly along x.
    #[serde(default = "up")]
    pub axis: Vector,
    /// What spheres have in common. Give this or `collider`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sphere: Option<Sphere>,
    /// The first collider, its position an offset; it is turned about the axis to make the others,
    /// with its velocities. Its name gets the number of each. Give this or `sphere`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub collider: Option<Collider>,
}

/// Rows, each centred on the one before.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = [{ "required": ["sphere"] }, { "required": ["collider"] }]))]
pub struct StaggeredRows {
    /// How many rows, >= 1.
    #[schemars(range(min = 1))]
    pub rows: u32,
    /// How many in each row, >= 1: [13, 12] staggers rows, [1, 2, 3] is a triangle. The list is
    /// repeated if there are more rows than numbers.
    #[schemars(length(min = 1))]
    pub counts: Vec<u32>,
    /// Centre of the first of the first row, in m.
    pub start: Vector,
    /// From each to the next in a row, in m.
    pub step: Vector,
    /// From the middle of each row to that of the next, in m.
    pub row_step: Vector,
    /// What spheres have in common. Give this or `collider`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sphere: Option<Sphere>,
    /// What colliders have in common; its position is an offset, its name gets the numbers of row
    /// and place. Give this or `sphere`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub collider: Option<Collider>,
}

impl StaggeredRows {
    /// Number of places in all rows.
    fn places(&self) -> u64 {
        let sum = |counts: &[u32]| counts.iter().map(|&count| u64::from(count)).sum::<u64>();
        let (rows, length) = (self.rows as usize, self.counts.len().max(1));
        let (times, rest) = (rows / length, rows % length);
        let whole = sum(&self.counts).saturating_mul(times as u64);
        whole.saturating_add(sum(&self.counts[..rest.min(self.counts.len())]))
    }
}

/// Order of the layers of a close packing.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Stacking {
    /// Hexagonal close packing: ABAB...
    #[default]
    Hcp,
    /// Face-centred cubic: ABCABC...
    Fcc,
}

impl Generator {
    /// Name of the kind of generator, as in scene files.
    pub(crate) fn kind(&self) -> &'static str {
        match self {
            Self::Row(_) => "row",
            Self::Lattice(_) => "lattice",
            Self::StaggeredRows(_) => "staggered-rows",
            Self::ClosePacking { .. } => "close-packing",
            Self::Ring(_) => "ring",
            Self::Random { .. } => "random",
        }
    }

    /// Number of spheres that it creates.
    pub fn count(&self) -> u64 {
        self.sphere().map_or(0, |_| self.places())
    }

    /// Number of spheres or colliders that it creates.
    pub(crate) fn places(&self) -> u64 {
        match self {
            Self::Row(row) => row.count.into(),
            Self::Ring(ring) => ring.count.into(),
            Self::Random { count, .. } => (*count).into(),
            Self::StaggeredRows(rows) => rows.places(),
            Self::Lattice(lattice) => product(&lattice.counts),
            Self::ClosePacking { counts, .. } => product(counts),
        }
    }

    /// Common properties of its spheres; `None` if it creates colliders.
    pub fn sphere(&self) -> Option<&Sphere> {
        match self {
            Self::ClosePacking { sphere, .. } | Self::Random { sphere, .. } => Some(sphere),
            Self::Row(row) => row.sphere.as_ref(),
            Self::Lattice(lattice) => lattice.sphere.as_ref(),
            Self::StaggeredRows(rows) => rows.sphere.as_ref(),
            Self::Ring(ring) => ring.sphere.as_ref(),
        }
    }

    /// Common properties of its colliders; `None` if it creates spheres.
    pub fn collider(&self) -> Option<&Collider> {
        match self {
            Self::ClosePacking { .. } | Self::Random { .. } => None,
            Self::Row(row) => row.collider.as_ref(),
            Self::Lattice(lattice) => lattice.collider.as_ref(),
            Self::StaggeredRows(rows) => rows.collider.as_ref(),
            Self::Ring(ring) => ring.collider.as_ref(),
        }
    }
}

fn product(counts: &[u32; 3]) -> u64 {
    counts.iter().fold(1, |total, &count| total.saturating_mul(count.into()))
}

fn up() -> Vector {
    [0.0, 1.0, 0.0]
}
