//! Corners of a mesh.

use std::sync::Arc;

use glam::{DQuat, DVec3};

use super::facet::{ROUNDING, ahead};
use crate::axis_motion::AlongAxis;
use crate::norm::Norm;

/// A corner, met where it is nearer than the edges and faces that end there.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Corner {
    /// \[m\]
    pub point: DVec3,
    /// From the frame of the mesh.
    pub rotation: DQuat,
    /// Unit vectors along what ends there, in the frame of the mesh: what is ahead along none of them is nearest
    /// to the corner.
    pub rays: Arc<[DVec3]>,
}

impl Corner {
    /// Whether the corner is what of the mesh is nearest to a centre \[m\], but for rounding.
    pub fn is_nearest(&self, center: DVec3) -> bool {
        self.is_behind(center, self.slack(center))
    }

    /// Whether it has a sphere with this centre \[m\] and velocity relative to it \[m/s\], as faces do.
    pub fn holds(&self, [center, velocity]: [DVec3; 2]) -> bool {
        self.is_behind(ahead([center, velocity], self.slack(center)), 0.0)
    }

    fn is_behind(&self, point: DVec3, slack: f64) -> bool {
        let offset = self.rotation.conjugate() * (point - self.point);
        self.rays.iter().all(|ray| offset.dot(*ray) <= slack)
    }

    /// Time \[s\] until a centre \[m\], by its motion along directions, may come to what is beside it.
    pub fn time_on<M: AlongAxis>(&self, center: DVec3, motion: impl Fn(DVec3) -> M) -> f64 {
        let (offset, slack) = (center - self.point, self.slack(center));
        self.rays.iter().fold(f64::INFINITY, |time, &ray| {
            let ray = self.rotation * ray;
            time.min(motion(ray).leaves(f64::NEG_INFINITY, slack - offset.dot(ray)))
        })
    }

    /// How far a centre \[m\] is at least from where the corner is what of the mesh is nearest; 0 there.
    pub fn distance_beside(&self, center: DVec3) -> f64 {
        let offset = self.rotation.conjugate() * (center - self.point);
        self.rays.iter().map(|ray| offset.dot(*ray)).fold(0.0, f64::max)
    }

    fn slack(&self, point: DVec3) -> f64 {
        ROUNDING * (point.norm() + self.point.norm())
    }
}
