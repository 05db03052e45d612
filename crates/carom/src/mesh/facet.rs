//! Flat faces of a mesh, without their edges.

use glam::{DVec2, DVec3};

use super::outline::{Outline, Side};
use crate::axis_motion::AlongAxis;
use crate::norm::Norm;
use crate::rectangle::Rectangle;

/// A flat face, met from its front where the foot of a sphere's centre is inside its outline.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Facet {
    /// Rectangle about the outline, whose coordinates count from its centre along its axes.
    pub frame: Rectangle,
    pub outline: Outline,
}

impl Facet {
    /// A whole rectangle.
    pub fn of_rectangle(frame: Rectangle) -> Self {
        let half = DVec2::new(frame.half_x, frame.half_z);
        let [a, b, c, d] = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
            .map(|corner| half * DVec2::from_array(corner));
        let sides = vec![
            Side::new([a, b], DVec2::NEG_Y),
            Side::new([b, c], DVec2::X),
            Side::new([c, d], DVec2::Y),
            Side::new([d, a], DVec2::NEG_X),
        ];
        Self { frame, outline: Outline::new(sides, vec![[a, b, c], [a, c, d]]) }
    }

    /// The same face, met from behind.
    pub fn turned(&self) -> Self {
        let frame = Rectangle { normal: -self.frame.normal, ..self.frame };
        Self { frame, outline: self.outline.clone() }
    }

    /// Height of a point above its plane \[m\].
    pub fn height_of(&self, point: DVec3) -> f64 {
        (point - self.frame.center).dot(self.frame.normal)
    }

    /// Whether the foot of a centre \[m\] is inside the outline, or outside by no more than rounding.
    pub fn is_under(&self, center: DVec3) -> bool {
        self.outline.is_within(self.local(center), self.slack(center))
    }

    /// Whether it has a sphere with this centre \[m\] and velocity relative to it \[m/s\]. At the very outline it
    /// has those that move inward; of it and what is beyond, one has the sphere.
    pub fn holds(&self, [center, velocity]: [DVec3; 2]) -> bool {
        self.outline.contains(self.local(ahead([center, velocity], self.slack(center))))
    }

    /// Time \[s\] until a centre \[m\], by its motion along directions, may come past the outline: it may be said
    /// too early, never too late.
    pub fn time_on<M: AlongAxis>(&self, center: DVec3, motion: impl Fn(DVec3) -> M) -> f64 {
        let (place, slack) = (self.local(center), self.slack(center));
        let mut time = f64::INFINITY;
        for side in self.outline.sides() {
            let [start, _] = side.ends;
            let beyond = (place - start).dot(side.outward);
            let outward = motion(self.world(side.outward));
            if beyond > slack {
                // Around a bend of the outline; looked at again when it has come to the line.
                time = time.min(outward.leaves(slack - beyond, f64::INFINITY));
                continue;
            }
            let leaves = outward.leaves(f64::NEG_INFINITY, slack - beyond);
            if leaves >= time {
                continue;
            }
            let along = motion(self.world(side.along));
            let is_beside = along.way(leaves).is_some_and(|way| {
                let there = (place - start).dot(side.along) + way;
                there < -slack || there > side.length + slack
            });
            if !is_beside {
                time = leaves;
            }
        }
        time
    }

    /// Height of its highest point above a plane, which is given by a point \[m\] and its normal.
    pub fn height_above(&self, [point, normal]: [DVec3; 2]) -> f64 {
        let Rectangle { center, axis_x, axis_z, .. } = self.frame;
        let base = (center - point).dot(normal);
        let rise = DVec2::new(axis_x.dot(normal), axis_z.dot(normal));
        self.outline.ends().map(|end| base + end.dot(rise)).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Returns whether its outline crosses that of another face in its plane.
    pub fn crosses(&self, other: &Self) -> bool {
        let place = |end: DVec2| self.frame.center + self.world(end);
        let sides =
            self.outline.sides().iter().map(|side| side.ends.map(|it| other.local(place(it))));
        sides.into_iter().any(|ends| other.outline.is_crossed_by(ends))
    }

    /// The triangles that cover it, in the world \[m\].
    pub fn triangles(&self) -> impl Iterator<Item = [DVec3; 3]> {
        let Rectangle { center, axis_x, axis_z, .. } = self.frame;
        let place = move |it: DVec2| center + it.x * axis_x + it.y * axis_z;
        self.outline.triangles().iter().map(move |corners| corners.map(place))
    }

    /// Its vertices in the world \[m\], each at least once.
    pub fn vertices(&self) -> impl Iterator<Item = DVec3> {
        let Rectangle { center, axis_x, axis_z, .. } = self.frame;
        self.outline.ends().map(move |end| center + end.x * axis_x + end.y * axis_z)
    }

    /// Coordinates of the foot of a point in the plane \[m\].
    pub fn local(&self, point: DVec3) -> DVec2 {
        self.local_direction(point - self.frame.center)
    }

    /// A direction of the world along the axes of the plane.
    pub fn local_direction(&self, direction: DVec3) -> DVec2 {
        DVec2::new(direction.dot(self.frame.axis_x), direction.dot(self.frame.axis_z))
    }

    /// A direction of the plane in the world.
    pub fn world(&self, direction: DVec2) -> DVec3 {
        direction.x * self.frame.axis_x + direction.y * self.frame.axis_z
    }

    /// Whether the foot of a point \[m\] is inside the outline, or no farther beside it than that \[m\].
    pub fn is_beside(&self, point: DVec3, beside: f64) -> bool {
        self.outline.is_within(self.local(point), beside)
    }

    /// How far the foot of a centre \[m\] is outside the outline; 0 inside.
    pub fn distance_beside(&self, center: DVec3) -> f64 {
        self.outline.distance(self.local(center))
    }

    /// Rounding of a place beside it \[m\].
    fn slack(&self, point: DVec3) -> f64 {
        let Rectangle { center, half_x, half_z, .. } = self.frame;
        ROUNDING * (point.norm() + center.norm() + half_x + half_z)
    }
}

/// What is closer to a border than this part of its coordinates may be on either side: what the time of a contact
/// and the way to it leave uncertain.
pub(super) const ROUNDING: f64 = 256.0 * f64::EPSILON;

/// A direction that no feature is made for: it decides where a sphere that moves along a border belongs.
const LEAD: DVec3 = DVec3::new(0.8, 0.36, 0.48);

/// A place \[m\] so little ahead of a centre on its way that only a border between features lies between, of
/// which rounding \[m\] leaves the side open.
pub(super) fn ahead([center, velocity]: [DVec3; 2], slack: f64) -> DVec3 {
    let speed = velocity.norm();
    let way = if speed > 0.0 { velocity / speed } else { DVec3::ZERO };
    center + slack * (4.0 * way + 0.25 * LEAD)
}
