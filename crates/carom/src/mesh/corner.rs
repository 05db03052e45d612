//! Corners of a mesh.

use std::sync::Arc;

use glam::{DQuat, DVec3};

use super::facet::{ROUNDING, WIDER, ahead};
use crate::axis_motion::AlongAxis;
use crate::norm::Norm;

/// A corner, which counts for points that are nearer to it than to its edges and faces.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Corner {
    /// Position \[m\].
    pub point: DVec3,
    /// Rotation from the coordinates of the mesh.
    pub rotation: DQuat,
    /// Unit vectors along the edges that end here, in the coordinates of the mesh. The corner is the nearest
    /// feature for points that lie ahead along none of them.
    pub rays: Arc<[DVec3]>,
    /// Whether spheres pass it from behind.
    pub is_open: bool,
}

impl Corner {
    /// Returns whether the corner is the nearest feature of the mesh to a centre \[m\], up to rounding.
    pub fn is_nearest(&self, center: DVec3) -> bool {
        self.is_behind(center, self.slack(center))
    }

    /// Returns whether a sphere with this centre \[m\] and relative velocity \[m/s\] belongs to the corner, by the
    /// rule of [`Facet::holds`](super::Facet::holds).
    pub fn holds(&self, [center, velocity]: [DVec3; 2]) -> bool {
        self.is_behind(ahead([center, velocity], self.slack(center)), 0.0)
    }

    fn is_behind(&self, point: DVec3, slack: f64) -> bool {
        let offset = self.rotation.conjugate() * (point - self.point);
        self.rays.iter().all(|ray| offset.dot(*ray) <= slack)
    }

    /// Returns the time \[s\] at which a centre \[m\] may leave the region of the corner, given its motion along a
    /// direction.
    pub fn time_on<M: AlongAxis>(&self, center: DVec3, motion: impl Fn(DVec3) -> M) -> f64 {
        let (offset, slack) = (center - self.point, self.slack(center));
        self.rays.iter().fold(f64::INFINITY, |time, &ray| {
            let ray = self.rotation * ray;
            time.min(motion(ray).leaves(f64::NEG_INFINITY, slack - offset.dot(ray)))
        })
    }

    /// Returns a lower bound of the distance \[m\] of a centre from the region in which the corner is the nearest
    /// feature; 0 inside.
    pub fn distance_beside(&self, center: DVec3) -> f64 {
        let offset = self.rotation.conjugate() * (center - self.point);
        self.rays.iter().map(|ray| offset.dot(*ray)).fold(0.0, f64::max)
    }

    /// Returns whether a sphere with this centre and radius \[m\] may come to meet the corner once it has moved by a
    /// distance `way` \[m\].
    pub fn may_be_met(&self, center: DVec3, radius: f64, way: f64) -> bool {
        (center - self.point).norm() <= radius + way && self.distance_beside(center) <= way
    }

    /// Returns a lower bound of the way \[m\] that a centre goes before the corner is the nearest feature to it, up to
    /// rounding.
    pub fn clearance(&self, center: DVec3) -> f64 {
        (self.distance_beside(center) - WIDER * self.slack(center)).max(0.0)
    }

    fn slack(&self, point: DVec3) -> f64 {
        ROUNDING * (point.norm() + self.point.norm())
    }
}
