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
    /// rows run along x, and every second row is shifted by half a sphere. In two dimensions each layer is one row.
    ClosePacking {
        /// Spheres in a row, layers, and rows in a layer (along x, y and z), each >= 1; one row in two dimensions.
        counts: [u32; 3],
        /// Centre of the first, in m.
        start: Vector,
        /// Distance of the centres of neighbours, in m, > 0. By default the diameter.
        #[schemars(extend("exclusiveMinimum" = 0.0))]
        #[serde(default, skip_serializing_if = "Option::is_none")]
        spacing: Option<f64>,
        /// The order of layers.
        #[serde(default)]
        stacking: Stacking,
        /// Properties of the spheres.
        sphere: Sphere,
    },
    /// Spheres or colliders evenly on a circle.
    Ring(Box<Ring>),
    /// Spheres scattered in a box, none overlapping another sphere or a collider.
    Random {
        /// How many, >= 1.
        #[schemars(range(min = 1))]
        count: u32,
        /// Lower corner of the box, in m. Whole spheres lie in it, or in two dimensions discs at z = 0.
        min: Vector,
        /// Upper corner of the box, in m.
        max: Vector,
        /// Seed; the same seed gives the same scene.
        seed: u32,
        /// Speed in a random direction, in m/s, >= 0, added to the velocity of `sphere`.
        #[schemars(range(min = 0.0))]
        #[serde(default)]
        speed: f64,
        /// Smallest and largest radius, in m, evenly distributed, instead of that of `sphere`.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        radius_range: Option<[f64; 2]>,
        /// Properties of the spheres.
        sphere: Sphere,
    },
    /// A dense fluid in equilibrium; beyond freezing, a disordered packing. Small spheres fly, collide and grow to their
    /// radii. They fill the periodic box of the simulation, or a box of their own, which nothing else may be in.
    DenseFluid(Box<DenseFluid>),
}

/// Spheres of a dense fluid.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DenseFluid {
    /// How many, from 1 to 100,000.
    #[schemars(range(min = 1, max = 100_000))]
    pub count: u32,
    /// Temperature k T of the velocities, in J, >= 0. The velocity of `sphere` is added.
    #[schemars(range(min = 0.0))]
    pub temperature: f64,
    /// Seed; the same seed gives the same scene.
    pub seed: u32,
    /// Part of the box that the spheres fill, in (0, 1), in two dimensions part of the area: their radii follow from it.
    /// Above 0.6 they may jam before. Give this, the radius of `sphere`, or `radius_range`.
    #[schemars(extend("exclusiveMinimum" = 0.0, "exclusiveMaximum" = 1.0))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub packing_fraction: Option<f64>,
    /// Smallest and largest radius, in m, evenly distributed, instead of that of `sphere`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub radius_range: Option<[f64; 2]>,
    /// Lower corner of a box with walls, in m, that whole spheres lie in; by default they fill the periodic box.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub min: Option<Vector>,
    /// Upper corner of that box, in m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max: Option<Vector>,
    /// Properties of the spheres.
    pub sphere: Sphere,
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
    /// Vector from each place to the next, in m.
    pub step: Vector,
    /// Properties of the spheres. Give this or `collider`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sphere: Option<Sphere>,
    /// Properties of the colliders. The position is an offset; the name gets a number. Give this or `sphere`.
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
    /// Properties of the spheres. Give this or `collider`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sphere: Option<Sphere>,
    /// Properties of the colliders. The position is an offset; the name gets numbers along x, y and z. Give this or
    /// `sphere`.
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
    /// Centre of the circle, in m.
    pub center: Vector,
    /// Radius of the circle, in m, > 0.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub radius: f64,
    /// Axis of the circle, of any length but zero. Places follow the right-hand rule. The first is at the side of
    /// +x, or of +y if the axis is nearly along x.
    #[serde(default = "up")]
    pub axis: Vector,
    /// Properties of the spheres. Give this or `collider`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sphere: Option<Sphere>,
    /// The first collider; the position is an offset. The others are turned about the axis, with their velocities; the
    /// name gets a number. Give this or `sphere`.
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
    /// Places in each row, >= 1: [13, 12] staggers rows, [1, 2, 3] is a triangle. If there are more rows than numbers,
    /// the numbers repeat.
    #[schemars(length(min = 1))]
    pub counts: Vec<u32>,
    /// Centre of the first of the first row, in m.
    pub start: Vector,
    /// Vector from each place to the next in a row, in m.
    pub step: Vector,
    /// Vector from the middle of each row to that of the next, in m.
    pub row_step: Vector,
    /// Properties of the spheres. Give this or `collider`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sphere: Option<Sphere>,
    /// Properties of the colliders. The position is an offset; the name gets the numbers of row and place. Give this or
    /// `sphere`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub collider: Option<Collider>,
}

impl StaggeredRows {
    /// Returns the number of places in all rows.
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
    /// Name of its kind, as it is written.
    pub(crate) fn kind(&self) -> &'static str {
        match self {
            Self::Row(_) => "row",
            Self::Lattice(_) => "lattice",
            Self::StaggeredRows(_) => "staggered-rows",
            Self::ClosePacking { .. } => "close-packing",
            Self::Ring(_) => "ring",
            Self::Random { .. } => "random",
            Self::DenseFluid(_) => "dense-fluid",
        }
    }

    /// Returns the number of spheres that the generator makes.
    pub fn count(&self) -> u64 {
        self.sphere().map_or(0, |_| self.places())
    }

    /// Returns the number of spheres or colliders that the generator makes.
    pub(crate) fn places(&self) -> u64 {
        match self {
            Self::Row(row) => row.count.into(),
            Self::Ring(ring) => ring.count.into(),
            Self::Random { count, .. } => (*count).into(),
            Self::DenseFluid(fluid) => fluid.count.into(),
            Self::StaggeredRows(rows) => rows.places(),
            Self::Lattice(lattice) => product(&lattice.counts),
            Self::ClosePacking { counts, .. } => product(counts),
        }
    }

    /// Returns the template of the spheres; `None` if the generator makes colliders.
    pub fn sphere(&self) -> Option<&Sphere> {
        match self {
            Self::ClosePacking { sphere, .. } | Self::Random { sphere, .. } => Some(sphere),
            Self::Row(row) => row.sphere.as_ref(),
            Self::Lattice(lattice) => lattice.sphere.as_ref(),
            Self::StaggeredRows(rows) => rows.sphere.as_ref(),
            Self::Ring(ring) => ring.sphere.as_ref(),
            Self::DenseFluid(fluid) => Some(&fluid.sphere),
        }
    }

    /// Returns the template of the colliders; `None` if the generator makes spheres.
    pub fn collider(&self) -> Option<&Collider> {
        match self {
            Self::ClosePacking { .. } | Self::Random { .. } | Self::DenseFluid(_) => None,
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
