//! Where the surfaces of a collider may be while it moves.

use glam::DVec3;

use crate::bounds::Bounds;
use crate::norm::Norm;

/// Distances are compared with this part of the coordinates to spare: far more than their rounding.
const MARGIN: f64 = 1e-9;

/// A region that holds all surfaces of a collider for as long as it moves so.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum SweptRegion {
    /// Bounds of all places of the surfaces, wider by far more than rounding.
    Within(Bounds),
    Behind(SweptPlane),
    Everywhere,
}

/// All places behind a plane that turns a little.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SweptPlane {
    /// Point of the plane at the start about which it turns \[m\].
    pub point: DVec3,
    pub normal: DVec3,
    /// Longest way of that point \[m\].
    pub way: f64,
    /// Largest angle \[rad\].
    pub angle: f64,
}

/// Bounds of the path of a sphere.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PathBounds {
    /// Centre at the start \[m\].
    pub center: DVec3,
    /// Longest way of the centre along each axis \[m\].
    pub way: DVec3,
    /// Radius of the sphere \[m\].
    pub radius: f64,
}

impl SweptRegion {
    /// Whether another region of the same collider is known to be within this one.
    pub fn holds(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Within(bounds), Self::Within(other)) => {
                bounds.min.cmple(other.min).all() && other.max.cmple(bounds.max).all()
            }
            (Self::Behind(plane), Self::Behind(other)) => {
                let rise = (other.point - plane.point).dot(plane.normal);
                let stays = plane.normal == other.normal && plane.angle == 0.0;
                stays && other.angle == 0.0 && rise + other.way <= plane.way
            }
            _ => false,
        }
    }
}

impl PathBounds {
    /// Whether the sphere stays outside a region.
    #[inline]
    pub fn misses(&self, region: &SweptRegion) -> bool {
        match region {
            SweptRegion::Within(bounds) => {
                let half = (self.way + self.radius) * (1.0 + MARGIN);
                !bounds.overlap(&Bounds::around(self.center, half))
            }
            SweptRegion::Behind(plane) => self.stays_above(plane),
            SweptRegion::Everywhere => false,
        }
    }

    fn stays_above(&self, &SweptPlane { point, normal, way, angle }: &SweptPlane) -> bool {
        let (offset, own) = (self.center - point, self.way.dot(normal.abs()));
        let margin =
            MARGIN * (offset.abs().element_sum() + self.way.element_sum() + self.radius + way);
        let beside = match angle > 0.0 {
            // The normal turns by no more than the angle.
            true => angle * (offset.norm() + self.way.norm() + way),
            false => 0.0,
        };
        offset.dot(normal) - own > self.radius + way + beside + margin
    }
}
