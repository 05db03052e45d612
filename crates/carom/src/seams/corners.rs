//! Corners without the directions that flush faces cover.

use glam::{DVec2, DVec3};

use super::face::FlushFace;
use crate::mesh::Corner;
use crate::norm::Norm;

/// Dot product up to which a unit vector does not point along another one: more than between the normals of flush
/// faces.
const BESIDE: f64 = 1e-8;
/// Length of the difference of two unit vectors that are one: more than their rounding, less than any angle that
/// counts.
const ONE: f64 = 1e-12;
/// Angle \[rad\] from its borders that the middle of a flat cone has at most.
const FLAT_CONE: f64 = 1e-6;

/// Parts of a corner that no face covers: one, or one for each side that spheres come from.
pub(super) fn uncovered(corner: &Corner, faces: &[&FlushFace]) -> Vec<Corner> {
    let own = corner.rays.iter().map(|&ray| corner.rotation * ray).collect();
    let mut cones: Vec<Vec<DVec3>> = vec![own];
    let mut is_whole = true;
    for face in faces {
        let rays = rays_from(face, corner.point);
        if rays.is_empty() {
            continue;
        }
        cones = cones.into_iter().flat_map(|cone| beside(cone, face.normal, &rays)).collect();
        is_whole = false;
        if cones.is_empty() {
            break;
        }
    }
    if is_whole {
        return vec![corner.clone()];
    }
    let back = corner.rotation.conjugate();
    let corner = |cone: Vec<DVec3>| {
        let rays = cone.into_iter().map(|ray| back * ray).collect();
        Corner { rays, ..corner.clone() }
    };
    cones.into_iter().map(corner).collect()
}

/// Parts of a cone beside a face with this normal and rays along it. The cone has the directions with no part along any
/// of its rays.
fn beside(cone: Vec<DVec3>, normal: DVec3, rays: &[DVec3]) -> Vec<Vec<DVec3>> {
    let borders = borders(&cone);
    let is_in_front = borders.iter().all(|it| it.dot(normal) >= -BESIDE);
    if borders.iter().all(|it| it.dot(normal) <= BESIDE) {
        return vec![cone];
    }
    let with = |more: &[DVec3]| -> Vec<DVec3> { distinct(cone.iter().chain(more).copied()) };
    let before = with(rays);
    if is_in_front {
        return if has_inside(&before) { vec![before] } else { Vec::new() };
    }
    let before: Vec<DVec3> = distinct(before.into_iter().chain([-normal]));
    let mut parts = vec![with(&[normal])];
    if has_inside(&before) {
        parts.push(before);
    }
    parts
}

/// Unit vectors without those that are one with an earlier one.
fn distinct(rays: impl Iterator<Item = DVec3>) -> Vec<DVec3> {
    let mut kept: Vec<DVec3> = Vec::new();
    for ray in rays {
        if !kept.iter().any(|it| (ray - *it).norm() <= ONE) {
            kept.push(ray);
        }
    }
    kept
}

/// Unit vectors along the lines in which two sides of a cone meet.
fn borders(rays: &[DVec3]) -> Vec<DVec3> {
    let is_in = |way: DVec3| rays.iter().all(|ray| way.dot(*ray) <= BESIDE);
    let mut borders = Vec::new();
    for (number, first) in rays.iter().enumerate() {
        for second in &rays[number + 1..] {
            let across = first.cross(*second);
            let length = across.norm();
            if length > BESIDE {
                let ways = [across / length, -across / length];
                borders.extend(ways.into_iter().filter(|&it| is_in(it)));
            }
        }
    }
    borders
}

/// Returns whether a cone is more than a plane or a line.
fn has_inside(rays: &[DVec3]) -> bool {
    let middle: DVec3 = borders(rays).into_iter().sum();
    let length = middle.norm();
    length > 0.0 && rays.iter().all(|ray| middle.dot(*ray) < -FLAT_CONE * length)
}

/// Unit vectors from a place \[m\] to the corners of the triangles of a face around it; none if it is not on the face.
fn rays_from(face: &FlushFace, place: DVec3) -> Vec<DVec3> {
    let height = (place - face.point).dot(face.normal);
    if height.abs() > face.step(f64::INFINITY) {
        return Vec::new();
    }
    let Some(facet) = &face.facet else {
        let across = face.normal.any_orthonormal_vector();
        let along = face.normal.cross(across);
        return vec![across, -across, along, -along];
    };
    let local = facet.local(place);
    let around = facet.outline.triangles().iter().filter(|it| is_on(it, local, 2.0 * face.gap));
    let ray = |end: DVec2| {
        let way = end - local;
        let length = way.dot(way).sqrt();
        (length > 4.0 * face.gap).then(|| facet.world(way / length))
    };
    around.flat_map(|corners| corners.map(ray)).flatten().collect()
}

/// Returns whether a point is in a triangle, or beside each of its sides by this \[m\] at most.
fn is_on(corners: &[DVec2; 3], point: DVec2, beside: f64) -> bool {
    let [a, b, c] = *corners;
    let turn = (b - a).perp_dot(c - a).signum();
    [[a, b], [b, c], [c, a]].into_iter().all(|[from, to]| {
        let way = to - from;
        turn * way.perp_dot(point - from) >= -beside * way.dot(way).sqrt()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cone_between_opposite_rays_is_flat() {
        let octant = [DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z];
        assert!(has_inside(&octant));
        let quarter_plane = [octant.as_slice(), &[DVec3::X]].concat();
        assert!(!has_inside(&quarter_plane));
    }

    #[test]
    fn a_point_far_beside_an_acute_corner_is_not_on_the_triangle() {
        let corners = [DVec2::ZERO, DVec2::X, DVec2::new(1.0, 0.1)];
        assert!(is_on(&corners, DVec2::new(0.5, -1e-13), 1e-12));
        assert!(!is_on(&corners, DVec2::new(-1e-9, 0.0), 1e-12));
    }
}
