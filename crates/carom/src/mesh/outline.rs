//! The outline of a flat face, in coordinates of its plane.

use std::sync::Arc;

use glam::DVec2;

/// The part of its plane that a flat face covers. Clones share their memory.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Outline(Arc<Parts>);

#[derive(Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct Parts {
    sides: Vec<Side>,
    triangles: Vec<[DVec2; 3]>,
}

/// A straight side of an outline.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Side {
    pub ends: [DVec2; 2],
    /// Unit vector from the first end to the second.
    pub along: DVec2,
    /// Unit vector that points out of the face.
    pub outward: DVec2,
    /// Length \[m\].
    pub length: f64,
}

impl Side {
    /// Creates a side between two ends \[m\].
    pub fn new(ends: [DVec2; 2], outward: DVec2) -> Self {
        let way = ends[1] - ends[0];
        let length = way.dot(way).sqrt();
        Self { ends, along: way / length, outward, length }
    }

    /// Returns its point that is nearest to a point \[m\].
    fn nearest(&self, point: DVec2) -> DVec2 {
        let along = (point - self.ends[0]).dot(self.along);
        if along >= self.length { self.ends[1] } else { self.ends[0] + along.max(0.0) * self.along }
    }

    fn distance_squared(&self, point: DVec2) -> f64 {
        (point - self.nearest(point)).length_squared()
    }
}

impl Outline {
    /// Creates an outline from sides, which form closed loops, and triangles that cover the area between them
    /// \[m\].
    pub fn new(sides: Vec<Side>, triangles: Vec<[DVec2; 3]>) -> Self {
        Self(Arc::new(Parts { sides, triangles }))
    }

    pub fn sides(&self) -> &[Side] {
        &self.0.sides
    }

    /// Returns both ends of each side \[m\]. The sides of a loop may differ in direction, so first ends alone may
    /// miss a vertex.
    pub fn ends(&self) -> impl Iterator<Item = DVec2> {
        self.sides().iter().flat_map(|side| side.ends)
    }

    /// Returns triangles that cover the face \[m\].
    pub fn triangles(&self) -> &[[DVec2; 3]] {
        &self.0.triangles
    }

    /// Returns whether a point \[m\] is inside: a line from it to infinity crosses an odd number of sides.
    pub fn contains(&self, point: DVec2) -> bool {
        let mut is_inside = false;
        for Side { ends: [a, b], .. } in self.sides() {
            if (a.y > point.y) != (b.y > point.y) {
                // The ends of a side are sorted, so that both of its faces get the same bits.
                let [low, high] = if a.y < b.y { [a, b] } else { [b, a] };
                let x = low.x + (point.y - low.y) / (high.y - low.y) * (high.x - low.x);
                is_inside ^= x > point.x;
            }
        }
        is_inside
    }

    /// Returns whether a line between two ends \[m\] crosses one of the sides.
    pub fn is_crossed_by(&self, [from, to]: [DVec2; 2]) -> bool {
        let parts = |[start, end]: [DVec2; 2], ends: [DVec2; 2]| {
            let [one, other] = ends.map(|it| (end - start).perp_dot(it - start));
            (one > 0.0) != (other > 0.0)
        };
        let crosses = |side: &Side| parts([from, to], side.ends) && parts(side.ends, [from, to]);
        self.sides().iter().any(crosses)
    }

    /// Returns the distance of a point from the face \[m\]; 0 inside.
    pub fn distance(&self, point: DVec2) -> f64 {
        if self.contains(point) {
            return 0.0;
        }
        let squares = self.sides().iter().map(|side| side.distance_squared(point));
        squares.fold(f64::INFINITY, f64::min).sqrt()
    }

    /// Returns the distance of a point from the sides \[m\], negative inside.
    pub fn signed_distance(&self, point: DVec2) -> f64 {
        let squares = self.sides().iter().map(|side| side.distance_squared(point));
        let distance = squares.fold(f64::INFINITY, f64::min).sqrt();
        if self.contains(point) { -distance } else { distance }
    }

    /// Returns whether a point \[m\] is inside, or at most `slack` \[m\] outside, which is more than rounding.
    pub fn is_within(&self, point: DVec2, slack: f64) -> bool {
        // A triangle is convex: clearly inside or outside, a point needs no exact test.
        if let [a, b, c] = self.sides() {
            let beyond = |side: &Side| (point - side.ends[0]).dot(side.outward);
            let most = beyond(a).max(beyond(b)).max(beyond(c));
            if most < -slack || most > 2.0 * slack {
                return most < 0.0;
            }
        }
        let is_near = |side: &Side| side.distance_squared(point) <= slack * slack;
        self.contains(point) || self.sides().iter().any(is_near)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square with a square hole.
    fn frame() -> Outline {
        let square = |half: f64| {
            let corners = [[-half, -half], [half, -half], [half, half], [-half, half]];
            (0..4).map(move |number| {
                let ends = [corners[number], corners[(number + 1) % 4]].map(DVec2::from_array);
                let way = ends[1] - ends[0];
                Side::new(ends, DVec2::new(way.y, -way.x).normalize())
            })
        };
        Outline::new(square(2.0).chain(square(1.0)).collect(), Vec::new())
    }

    #[test]
    fn a_hole_is_outside() {
        let outline = frame();
        assert!(outline.contains(DVec2::new(1.5, 0.3)));
        assert!(!outline.contains(DVec2::new(0.5, 0.3)));
        assert!(!outline.contains(DVec2::new(2.5, 0.3)));
        assert!(outline.is_within(DVec2::new(2.0 + 1e-13, 0.3), 2e-13));
        assert!(!outline.is_within(DVec2::new(2.0 + 1e-12, 0.3), 2e-13));
    }
}
