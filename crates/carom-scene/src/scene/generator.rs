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
    /// Rows of spheres or colliders, each centred on the one before: staggered, in a triangle, or
    /// straight, such as the pegs of a Galton board.
    StaggeredRows(Box<StaggeredRows>),
    /// Close packing of equal spheres in hexagonal layers, one above the other along +y: in a layer
    /// rows run along x, and every second row is shifted by half a sphere.
    ClosePacking {
        /// Number of spheres in a row, of layers, and of rows in a layer: along x, y and z, each >=
        /// 1.
        counts: [u32; 3],
        /// Centre of the first, in m.
        start: Vector,
        /// Distance of the centres of neighbours, in m, > 0; the diameter where it is missing.
        #[schemars(extend("exclusiveMinimum" = 0.0))]
        #[serde(default, skip_serializing_if = "Option::is_none")]
        spacing: Option<f64>,
        /// Order of the layers.
        #[serde(default)]
        stacking: Stacking,
        /// Common properties of the spheres.
        sphere: Sphere,
    },
    /// Spheres or colliders evenly on a circle.
    Ring(Box<Ring>),
    /// Spheres scattered in a box, none overlapping another sphere or a collider.
    Random {
        /// Number of spheres, >= 1.
        #[schemars(range(min = 1))]
        count: u32,
        /// Lower corner of the box that holds the whole spheres, in m.
        min: Vector,
        /// Upper corner of the box, in m.
        max: Vector,
        /// Seed of the random numbers: the same seed creates the same scene.
        seed: u32,
        /// Speed, in m/s, >= 0, in a random direction, on top of the common velocity.
        #[schemars(range(min = 0.0))]
        #[serde(default)]
        speed: f64,
        /// Smallest and largest radius, in m, evenly distributed, instead of the common one.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        radius_range: Option<[f64; 2]>,
        /// Common properties of the spheres.
        sphere: Sphere,
    },
}

/// Places one after the other along a line.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = [{ "required": ["sphere"] }, { "required": ["collider"] }]))]
pub struct Row {
    /// Number of places, >= 1.
    #[schemars(range(min = 1))]
    pub count: u32,
    /// Centre of the first, in m.
    pub start: Vector,
    /// Step from each centre to the next, in m.
    pub step: Vector,
    /// Common properties of spheres. Give this or `collider`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sphere: Option<Sphere>,
    /// Common properties of colliders; the position is an offset, and the name gets the number of
    /// the place. Give this or `sphere`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub collider: Option<Collider>,
}

/// Places on a box-shaped lattice; x runs fastest, then y, then z.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = [{ "required": ["sphere"] }, { "required": ["collider"] }]))]
pub struct Lattice {
    /// Numbers of places along x, y and z, each >= 1.
    pub counts: [u32; 3],
    /// Centre of the first, in m.
    pub start: Vector,
    /// Distance of neighbours along x, y and z, in m.
    pub spacing: Vector,
    /// Common properties of spheres. Give this or `collider`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sphere: Option<Sphere>,
    /// Common properties of colliders; the position is an offset, and the name gets the numbers
    /// along x, y and z. Give this or `sphere`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub collider: Option<Collider>,
}

/// Places evenly on a circle.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = [{ "required": ["sphere"] }, { "required": ["collider"] }]))]
pub struct Ring {
    /// Number of places, >= 1.
    #[schemars(range(min = 1))]
    pub count: u32,
    /// Centre of the circle, in m.
    pub center: Vector,
    /// Radius of the circle, in m, > 0.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub radius: f64,
    /// Axis of the circle, of any length but zero; places follow each other about it by the
    /// right-hand rule. The first is at the side of +x, or of +y if the axis is nearly along x.
    #[serde(default = "up")]
    pub axis: Vector,
    /// Common properties of spheres. Give this or `collider`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sphere: Option<Sphere>,
    /// The first collider; its position is an offset. It is turned about the axis, with its
    /// velocities, to create the others. The name gets the number of the place. Give this or
    /// `sphere`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub collider: Option<Collider>,
}

/// Rows, each centred on the one before.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = [{ "required": ["sphere"] }, { "required": ["collider"] }]))]
pub struct StaggeredRows {
    /// Number of rows, >= 1.
    #[schemars(range(min = 1))]
    pub rows: u32,
    /// Numbers of places in each row, >= 1: [13, 12] staggers rows, [1, 2, 3] is a triangle. The
    /// list is repeated if there are more rows than numbers.
    #[schemars(length(min = 1))]
    pub counts: Vec<u32>,
    /// Centre of the first place of the first row, in m.
    pub start: Vector,
    /// Step from each place to the next in a row, in m.
    pub step: Vector,
    /// Step from the middle of each row to that of the next, in m.
    pub row_step: Vector,
    /// Common properties of spheres. Give this or `collider`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sphere: Option<Sphere>,
    /// Common properties of colliders; the position is an offset, and the name gets the numbers of
    /// row and place. Give this or `sphere`.
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
