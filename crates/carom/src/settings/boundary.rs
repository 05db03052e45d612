use glam::DVec3;

use crate::error::InvalidValue;
use crate::validate;

/// What is around the spheres, besides colliders.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Boundary {
    /// Nothing: space without end.
    #[default]
    Open,
    /// A box about the origin that repeats itself: what leaves through a face comes in through the
    /// opposite one, and spheres meet across faces. Only under the rule `exact`.
    Periodic {
        /// Edges \[m\], each > 0; infinite along an axis that is open.
        size: DVec3,
    },
}

impl Boundary {
    /// Edges of the periodic box \[m\], infinite along open axes.
    pub(crate) fn period(self) -> DVec3 {
        match self {
            Self::Open => DVec3::INFINITY,
            Self::Periodic { size } => size,
        }
    }

    pub(super) fn validate(self) -> Result<(), InvalidValue> {
        let size = self.period();
        let requirement = "positive along every axis; infinite where it is open";
        validate::require(size.cmpgt(DVec3::ZERO).all(), "size", requirement, size)
    }
}
