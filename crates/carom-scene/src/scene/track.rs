//! Tracks of scenes: gutters along a path that pieces describe.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::mesh::Made;
use super::values::is_default;

/// A gutter along a path, as of a marble run. The path begins at the origin towards local +x; the gutter lies on it
/// with its lowest line. It is a mesh of flat facets. Its wall has no thickness; spheres bounce off both sides.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Track {
    /// Radius of its round cross-section, in m, > 0.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub radius: f64,
    /// Parts of the path, one after the other.
    #[schemars(length(min = 1))]
    pub pieces: Vec<Piece>,
    /// How much of a circle the cross-section is, in degrees, > 0 and at most 360, a tube. By default 180.
    #[schemars(range(max = 360.0), extend("exclusiveMinimum" = 0.0))]
    #[serde(default = "half", skip_serializing_if = "is_half")]
    pub arc_degrees: f64,
    /// Facets across, an odd number from 3 to 999, so that one of them is the lowest. By default 21.
    #[schemars(range(min = 3, max = 999))]
    #[serde(default = "many", skip_serializing_if = "are_many")]
    pub sides: u32,
    /// Largest angle between neighbouring facets along the path, in degrees, from 0.1 to 45. By default 3.
    #[schemars(range(min = 0.1, max = 45.0))]
    #[serde(default = "three", skip_serializing_if = "is_three")]
    pub facet_degrees: f64,
    /// Slope at the beginning, in degrees, positive upward. By default level.
    #[serde(default, skip_serializing_if = "is_default")]
    pub pitch_degrees: f64,
    #[serde(skip)]
    made: Made<Track>,
}

/// A part of the path of a track. Each begins where the one before it ends, in its direction.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Piece {
    /// Goes straight on.
    Straight {
        /// In m, > 0.
        #[schemars(extend("exclusiveMinimum" = 0.0))]
        length: f64,
    },
    /// Goes to the left or the right, with the slope that it begins with: an arc, or a helix.
    Curve {
        /// As seen from above, in m, larger than that of the cross-section.
        #[schemars(extend("exclusiveMinimum" = 0.0))]
        radius: f64,
        /// How far it goes round, in degrees, positive to the left.
        degrees: f64,
        /// How far the cross-section turns inward in its middle, so that the outer wall is higher, in degrees. By
        /// default 0.
        #[serde(default, skip_serializing_if = "is_default")]
        bank_degrees: f64,
    },
    /// Goes upward or downward. One of 360 degrees with a shift is a loop.
    Bend {
        /// In m, larger than that of the cross-section.
        #[schemars(extend("exclusiveMinimum" = 0.0))]
        radius: f64,
        /// How much the slope changes, in degrees, positive upward.
        degrees: f64,
        /// How far it comes to the left meanwhile, in m; negative to the right. By default 0.
        #[serde(default, skip_serializing_if = "is_default")]
        shift: f64,
    },
    /// Has no gutter, to be jumped over.
    Gap {
        /// Along the level, in m, >= 0.
        #[schemars(range(min = 0.0))]
        length: f64,
        /// How much lower its end is, in m; negative for higher. By default 0.
        #[serde(default, skip_serializing_if = "is_default")]
        drop: f64,
        /// Slope at its end, in degrees, positive upward. By default that of its beginning.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pitch_degrees: Option<f64>,
    },
}

impl Track {
    /// A track of a half-round gutter with this radius \[m\], which begins level.
    pub fn new(radius: f64, pieces: Vec<Piece>) -> Self {
        Self {
            radius,
            pieces,
            arc_degrees: half(),
            sides: many(),
            facet_degrees: three(),
            pitch_degrees: 0.0,
            made: Made::default(),
        }
    }

    /// Returns what `make` makes of the description. It is called once.
    pub(crate) fn mesh(
        &self,
        make: impl Fn(&Self) -> Result<carom::Mesh, String>,
    ) -> Result<carom::Mesh, String> {
        let alone = || Self { made: Made::default(), ..self.clone() };
        self.made.get(self, alone, || make(self))
    }
}

impl Piece {
    /// Name of its kind, as it is written.
    pub(crate) fn kind(&self) -> &'static str {
        match self {
            Self::Straight { .. } => "straight",
            Self::Curve { .. } => "curve",
            Self::Bend { .. } => "bend",
            Self::Gap { .. } => "gap",
        }
    }
}

fn half() -> f64 {
    180.0
}

fn is_half(degrees: &f64) -> bool {
    *degrees == half()
}

fn many() -> u32 {
    21
}

fn are_many(sides: &u32) -> bool {
    *sides == many()
}

fn three() -> f64 {
    3.0
}

fn is_three(degrees: &f64) -> bool {
    *degrees == three()
}
