//! Edges of a mesh, without their ends.

use glam::DVec3;

use super::facet::{ROUNDING, ahead};
use crate::axis_motion::AlongAxis;
use crate::norm::Norm;

/// A straight edge, met where it is nearer than the faces beside it and the corners at its ends.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Edge {
    /// \[m\]
    pub center: DVec3,
    /// Unit vector along it.
    pub axis: DVec3,
    /// Half its length \[m\].
    pub half: f64,
    /// Unit vectors across it, each out of one of its faces: what is beyond both is nearest to the edge. The
    /// same one twice where that is all.
    pub outward: [DVec3; 2],
}

impl Edge {
    /// Whether the edge is what of the mesh is nearest to a centre \[m\], but for rounding.
    pub fn is_nearest(&self, center: DVec3) -> bool {
        self.is_beyond(center, self.slack(center))
    }

    /// Whether it has a sphere with this centre \[m\] and velocity relative to it \[m/s\], as faces do.
    pub fn holds(&self, [center, velocity]: [DVec3; 2]) -> bool {
        self.is_beyond(ahead([center, velocity], self.slack(center)), 0.0)
    }

    fn is_beyond(&self, point: DVec3, slack: f64) -> bool {
        let offset = point - self.center;
        offset.dot(self.axis).abs() <= self.half + slack
            && self.outward.iter().all(|outward| offset.dot(*outward) >= -slack)
    }

    /// The point of its line that is nearest to another one \[m\].
    pub fn foot_of(&self, point: DVec3) -> DVec3 {
        self.center + (point - self.center).dot(self.axis) * self.axis
    }

    /// Time \[s\] until a centre \[m\], by its motion along directions, may come to what is beside it.
    pub fn time_on<M: AlongAxis>(&self, center: DVec3, motion: impl Fn(DVec3) -> M) -> f64 {
        let (offset, slack) = (center - self.center, self.slack(center));
        let along = offset.dot(self.axis);
        let end = self.half + slack;
        let ends = motion(self.axis).leaves(-end - along, end - along);
        self.outward.iter().fold(ends, |time, &outward| {
            let beyond = offset.dot(outward);
            time.min(motion(outward).leaves(-slack - beyond, f64::INFINITY))
        })
    }

    /// Height of its highest point above a plane, which is given by a point \[m\] and its normal.
    pub fn height_above(&self, [point, normal]: [DVec3; 2]) -> f64 {
        (self.center - point).dot(normal) + self.half * self.axis.dot(normal).abs()
    }

    /// Distance of a point from it \[m\].
    pub fn distance_of(&self, point: DVec3) -> f64 {
        let offset = point - self.center;
        let along = offset.dot(self.axis).clamp(-self.half, self.half);
        (offset - along * self.axis).norm()
    }

    /// How far a centre \[m\] is at least from where the edge is what of the mesh is nearest; 0 there.
    pub fn distance_beside(&self, center: DVec3) -> f64 {
        let offset = center - self.center;
        let past_ends = offset.dot(self.axis).abs() - self.half;
        let beside = self.outward.iter().map(|outward| -offset.dot(*outward));
        beside.fold(past_ends, f64::max).max(0.0)
    }

    fn slack(&self, point: DVec3) -> f64 {
        ROUNDING * (point.norm() + self.center.norm() + self.half)
    }
}
