//! The volume that a closed mesh encloses.

use glam::{DQuat, DVec3};

use super::topology::Topology;
use crate::bounds::Bounds;
use crate::bounds_tree::{Bounded, BoundsTree};
use crate::norm::Norm;

/// The volume that a closed mesh encloses: points with a winding number of at least 1, where triangles that face
/// outward count positive.
///
/// Coordinates are rotated so that z is the direction of the ray that tests a point. The direction is unlikely to
/// be along any feature.
#[derive(Debug)]
pub(super) struct Interior {
    vertices: Vec<DVec3>,
    triangles: BoundsTree<Triangle>,
}

/// Depth of a point inside a mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Depth {
    /// Distance to the surface \[m\], >= 0.
    pub depth: f64,
    /// Unit vector to the nearest point of the surface.
    pub normal: DVec3,
}

/// A triangle, by the indices of its vertices.
#[derive(Debug, Clone)]
struct Triangle {
    number: u32,
    corners: [u32; 3],
    bounds: Bounds,
}

impl Bounded for Triangle {
    type Order = u32;

    fn bounds(&self) -> &Bounds {
        &self.bounds
    }

    fn order(&self) -> u32 {
        self.number
    }
}

/// Returns the rotation from the coordinates of a mesh to those of the ray, which points along z.
fn view() -> DQuat {
    DQuat::from_xyzw(0.31, 0.52, -0.23, 0.76).normalize()
}

impl Interior {
    /// Creates the volume of a closed mesh.
    pub fn of(topology: &Topology) -> Self {
        let view = view();
        let vertices: Vec<DVec3> = topology.vertices.iter().map(|&it| view * it).collect();
        let triangle = |(number, &corners): (usize, &[u32; 3])| {
            let [a, b, c] = corners.map(|it| vertices[it as usize]);
            let bounds = Bounds { min: a.min(b).min(c), max: a.max(b).max(c) };
            Triangle { number: number as u32, corners, bounds }
        };
        let triangles = topology.triangles.iter().enumerate().map(triangle).collect();
        let triangles = BoundsTree::of(triangles, Vec::new(), true);
        Self { vertices, triangles }
    }

    /// Returns the depth of a point \[m\]; `None` outside.
    pub fn depth_at(&self, point: DVec3) -> Option<Depth> {
        let view = view();
        let point = view * point;
        if self.winding_number(point) <= 0 {
            return None;
        }
        let (mut least, mut nearest) = (f64::INFINITY, None);
        let bound = |bounds: &Bounds| bounds.distance_below(point);
        self.triangles.search(&bound, &mut least, &mut |triangle, limit| {
            let (depth, normal) = nearest_of(point, self.corners_of(triangle));
            let is_nearer = nearest.is_none_or(|(best, number, _)| {
                depth < best || (depth == best && triangle.number < number)
            });
            if is_nearer {
                nearest = Some((depth, triangle.number, normal));
                *limit = depth;
            }
        });
        nearest.map(|(depth, _, normal)| Depth { depth, normal: view.conjugate() * normal })
    }

    /// Returns the winding number of the surface about a point \[m\]: how often a ray from there leaves the
    /// surface, minus how often it enters.
    ///
    /// For the two triangles at an edge, the same comparison decides on which side of the edge the ray is, so the
    /// ray hits exactly one of them.
    fn winding_number(&self, point: DVec3) -> i32 {
        let ray = Bounds { min: point, max: point.with_z(f64::INFINITY) };
        let bound = |bounds: &Bounds| if bounds.overlap(&ray) { 0.0 } else { f64::INFINITY };
        let mut winding_number = 0;
        self.triangles.search(&bound, &mut 0.0, &mut |triangle, _| {
            let corners @ [a, b, c] = self.corners_of(triangle);
            let turn = turn_about(point, corners);
            let height = (point - a).dot((b - a).cross(c - a));
            // A triangle that faces along the ray is hit if the point is behind it, any other if the point is in
            // front.
            if turn != 0 && (height < 0.0) == (turn > 0) {
                winding_number += turn;
            }
        });
        winding_number
    }

    fn corners_of(&self, triangle: &Triangle) -> [DVec3; 3] {
        triangle.corners.map(|it| self.vertices[it as usize])
    }
}

/// Returns 1 if a triangle, seen against the ray, goes round a point counter-clockwise, -1 if clockwise, 0 if not
/// at all.
fn turn_about(point: DVec3, [a, b, c]: [DVec3; 3]) -> i32 {
    let side = |from: DVec3, to: DVec3| {
        let rises = from.y <= point.y;
        if rises == (to.y <= point.y) {
            return 0;
        }
        // The ends of an edge are sorted, so that both of its triangles get the same bits, and x stays between the
        // ends.
        let [low, high] = if rises { [from, to] } else { [to, from] };
        let x = low.x + (point.y - low.y) / (high.y - low.y) * (high.x - low.x);
        let is_beyond = x.clamp(low.x.min(high.x), low.x.max(high.x)) > point.x;
        i32::from(is_beyond) * if rises { 1 } else { -1 }
    };
    side(a, b) + side(b, c) + side(c, a)
}

/// Returns the distance \[m\] of a point from a triangle, and the unit vector from it to the nearest point of the
/// triangle.
fn nearest_of(point: DVec3, corners @ [a, b, c]: [DVec3; 3]) -> (f64, DVec3) {
    let area = (b - a).cross(c - a);
    let normal = area / area.norm();
    let height = (a - point).dot(normal);
    let foot = point + height * normal;
    let is_inward = |from: DVec3, to: DVec3| (to - from).cross(foot - from).dot(normal) >= 0.0;
    if is_inward(a, b) && is_inward(b, c) && is_inward(c, a) {
        let towards = if height < 0.0 { -normal } else { normal };
        return (height.abs(), towards);
    }
    let on_side = |number: usize| {
        let (from, to) = (corners[number], corners[(number + 1) % 3]);
        let way = to - from;
        let part = ((point - from).dot(way) / way.length_squared()).clamp(0.0, 1.0);
        from + part * way - point
    };
    let ways = [0, 1, 2].map(on_side);
    let way = ways.into_iter().fold(ways[0], |best, way| {
        if way.length_squared() < best.length_squared() { way } else { best }
    });
    let distance = way.norm();
    (distance, if distance > 0.0 { way / distance } else { normal })
}
