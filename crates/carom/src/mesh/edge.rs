//! Edges of a mesh, without their end points.

use glam::DVec3;

use super::facet::{ROUNDING, WIDER, ahead};
use crate::axis_motion::AlongAxis;
use crate::norm::Norm;

/// A straight edge, which counts for points that are nearer to it than to its faces and end points.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Edge {
    /// Middle of the edge \[m\].
    pub center: DVec3,
    /// Unit vector along the edge.
    pub axis: DVec3,
    /// Half the length \[m\].
    pub half: f64,
    /// Unit vectors across the edge, each away from one of its faces. The edge is the nearest feature for points
    /// beyond both. An edge of one face has the same vector twice.
    pub outward: [DVec3; 2],
    /// Whether it is an edge of one face. The second vector across it is then the normal of that face.
    pub is_border: bool,
    /// Whether spheres pass it from behind.
    pub is_open: bool,
}

impl Edge {
    /// Returns whether the edge is the nearest feature of the mesh to a centre \[m\], up to rounding.
    pub fn is_nearest(&self, center: DVec3) -> bool {
        self.is_beyond(center, self.slack(center))
    }

    /// Returns whether a sphere with this centre \[m\] and relative velocity \[m/s\] belongs to the edge, by the
    /// rule of [`Facet::holds`](super::Facet::holds).
    pub fn holds(&self, [center, velocity]: [DVec3; 2]) -> bool {
        self.is_beyond(ahead([center, velocity], self.slack(center)), 0.0)
    }

    fn is_beyond(&self, point: DVec3, slack: f64) -> bool {
        let offset = point - self.center;
        offset.dot(self.axis).abs() <= self.half + slack
            && self.outward.iter().all(|outward| offset.dot(*outward) >= -slack)
    }

    /// Returns whether a centre \[m\] beyond a border is behind the plane of its face, by less than a radius \[m\].
    pub fn is_seen_from_behind(&self, center: DVec3, radius: f64) -> bool {
        if !self.is_border {
            return false;
        }
        let offset = center - self.center;
        let [outward, normal] = self.outward.map(|direction| offset.dot(direction));
        let is_beside =
            offset.dot(self.axis).abs() <= self.half && (0.0..radius).contains(&outward);
        is_beside && -radius < normal && normal < 0.0
    }

    /// Returns whether a sphere with this centre and radius \[m\] may come to meet the edge, from behind a border as
    /// well, once it has moved by a distance `way` \[m\].
    pub fn may_be_met(&self, center: DVec3, radius: f64, way: f64) -> bool {
        let is_near = self.distance_of(center) <= radius + way;
        is_near && (self.is_border || self.distance_beside(center) <= way)
    }

    /// Returns the point of its line that is nearest to a point \[m\].
    pub fn foot_of(&self, point: DVec3) -> DVec3 {
        self.center + (point - self.center).dot(self.axis) * self.axis
    }

    /// Returns the time \[s\] at which a centre \[m\] may leave the region of the edge, given its motion along a
    /// direction.
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

    /// Returns the height \[m\] of its highest point above a plane, given by a point \[m\] and a normal.
    pub fn height_above(&self, [point, normal]: [DVec3; 2]) -> f64 {
        (self.center - point).dot(normal) + self.half * self.axis.dot(normal).abs()
    }

    /// Returns the distance of a point \[m\] from the edge \[m\].
    pub fn distance_of(&self, point: DVec3) -> f64 {
        let offset = point - self.center;
        let along = offset.dot(self.axis).clamp(-self.half, self.half);
        (offset - along * self.axis).norm()
    }

    /// Returns a lower bound of the distance \[m\] of a centre from the region in which the edge is the nearest
    /// feature; 0 inside.
    pub fn distance_beside(&self, center: DVec3) -> f64 {
        let offset = center - self.center;
        let past_ends = offset.dot(self.axis).abs() - self.half;
        let beside = self.outward.iter().map(|outward| -offset.dot(*outward));
        beside.fold(past_ends, f64::max).max(0.0)
    }

    /// Returns a lower bound of the way \[m\] that a centre goes before the edge is the nearest feature to it, up to
    /// rounding.
    pub fn clearance(&self, center: DVec3) -> f64 {
        (self.distance_beside(center) - WIDER * self.slack(center)).max(0.0)
    }

    fn slack(&self, point: DVec3) -> f64 {
        ROUNDING * (point.norm() + self.center.norm() + self.half)
    }
}
