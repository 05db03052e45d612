//! Corners of a mesh.

use glam::{DQuat, DVec3};

use super::borders::Borders;
use super::faces::Faces;
use crate::mesh::Corner;
use crate::mesh::topology::Topology;
use crate::norm::Norm;

/// Largest dot product of unit vectors that counts as zero.
const BESIDE: f64 = 1e-9;
/// Number of rays up to which a corner is tested for points to which it is the nearest feature; a corner with more
/// rays is always kept.
const MANY_RAYS: usize = 16;

/// Returns the corners that spheres can meet: end points of borders that are the nearest feature for some point.
pub(super) fn corners(
    topology: &Topology,
    faces: &Faces,
    borders: &Borders,
    is_two_sided: bool,
) -> Vec<Corner> {
    let normals = if is_two_sided { Vec::new() } else { normals(topology, faces) };
    let mut ways: Vec<[u32; 2]> = Vec::new();
    for edge in topology.edges() {
        let [first, second] = edge.ends;
        ways.extend([[first, second], [second, first]]);
    }
    ways.sort_unstable();
    let place = |vertex: u32| topology.vertices[vertex as usize];
    let around = ways.chunk_by(|first, second| first[0] == second[0]);
    let corner = |around: &[[u32; 2]]| {
        let vertex = around[0][0];
        if !borders.is_end[vertex as usize] {
            return None;
        }
        let point = place(vertex);
        let ray = |way: &[u32; 2]| {
            let ray = place(way[1]) - point;
            ray / ray.norm()
        };
        let mut rays: Vec<DVec3> = around.iter().map(ray).collect();
        let normal = normals.get(vertex as usize).copied();
        if rays.len() <= MANY_RAYS && !is_met(&rays, normal) {
            return None;
        }
        // Points behind one-sided faces are never nearest to the corner.
        rays.extend(normal.map(|normal| -normal));
        let rotation = DQuat::IDENTITY;
        Some(Corner { point, rotation, rays: rays.into(), is_open: false })
    };
    around.filter_map(corner).collect()
}

/// Returns whether a direction exists that points along none of the rays, and to the front of faces with this mean
/// normal.
fn is_met(rays: &[DVec3], normal: Option<DVec3>) -> bool {
    let (mut sum, mut count) = (DVec3::ZERO, 0);
    let is_behind = |way: DVec3| rays.iter().all(|ray| way.dot(*ray) <= BESIDE);
    for (number, first) in rays.iter().enumerate() {
        for second in &rays[number + 1..] {
            let across = first.cross(*second);
            let length = across.norm();
            if length <= BESIDE {
                continue;
            }
            for way in [across / length, -across / length] {
                if is_behind(way) {
                    sum += way;
                    count += 1;
                }
            }
        }
    }
    let is_in_front = |normal: DVec3| sum.dot(normal) >= -BESIDE * sum.norm();
    count > 0 && normal.is_none_or(is_in_front)
}

/// Returns the unit normal of each vertex: the sum of the normals of its faces, weighted by their angles there. Its
/// sign separates front from back for all points whose nearest feature is the vertex (Baerentzen and Aanaes, IEEE
/// TVCG 11, 243 (2005)).
fn normals(topology: &Topology, faces: &Faces) -> Vec<DVec3> {
    let mut normals = vec![DVec3::ZERO; topology.vertices.len()];
    for (corners, &face) in topology.triangles.iter().zip(&faces.of) {
        let places = corners.map(|it| topology.vertices[it as usize]);
        for corner in 0..3 {
            let to_next = places[(corner + 1) % 3] - places[corner];
            let to_last = places[(corner + 2) % 3] - places[corner];
            let angle = libm::atan2(to_next.cross(to_last).norm(), to_next.dot(to_last));
            normals[corners[corner] as usize] += angle * faces.normals[face as usize];
        }
    }
    let unit = |normal: DVec3| {
        let length = normal.norm();
        if length > 0.0 { normal / length } else { normal }
    };
    normals.into_iter().map(unit).collect()
}
