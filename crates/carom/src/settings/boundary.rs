use glam::DVec3;

use crate::error::InvalidValue;
use crate::validate;

/// The boundary of space, besides colliders.
///
/// ```
/// use carom::{Boundary, DVec3, Settings, Sphere, World};
///
/// let size = DVec3::new(4.0, f64::INFINITY, f64::INFINITY);
/// let settings = Settings::default().with_boundary(Boundary::Periodic { size });
/// let mut world = World::new(settings)?;
/// let to_the_right = Sphere::new(DVec3::ZERO, 0.5).with_velocity(DVec3::X);
/// let id = world.add_sphere(to_the_right)?;
/// world.step(3.0)?;
/// // Out at 2, and in again at -2.
/// assert_eq!(world.sphere(id)?.position, DVec3::NEG_X);
/// # Ok::<(), carom::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Boundary {
    /// No boundary: space without end.
    #[default]
    Open,
    /// A box about the origin that repeats itself: a sphere that leaves through a face enters through the opposite
    /// one, and spheres meet across faces. Only under the rules `exact` and `contact`.
    Periodic {
        /// Edges \[m\], each > 0; infinite along an axis that is open.
        size: DVec3,
    },
}

/// The image of a place that is nearest to the origin \[m\], in a box with these edges \[m\], infinite along
/// open axes.
pub(crate) fn nearest_image(place: DVec3, period: DVec3) -> DVec3 {
    let boxes = (place / period).round();
    place - DVec3::select(period.is_finite_mask(), boxes * period, DVec3::ZERO)
}

impl Boundary {
    /// The image of a distance that is the shortest \[m\].
    pub fn nearest_image(self, distance: DVec3) -> DVec3 {
        nearest_image(distance, self.period())
    }

    /// Whether space repeats itself along some axis.
    pub fn is_periodic(self) -> bool {
        self.period() != DVec3::INFINITY
    }

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
