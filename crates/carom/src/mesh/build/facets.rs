//! Flat faces of a mesh with their outlines.

use glam::{DVec2, DVec3};

use super::borders::{Border, Borders};
use super::faces::Faces;
use crate::mesh::Facet;
use crate::mesh::outline::{Outline, Side};
use crate::mesh::topology::Topology;
use crate::norm::Norm;
use crate::rectangle::Rectangle;

/// Returns the faces with their outlines.
pub(super) fn facets(faces: &Faces, topology: &Topology, borders: &Borders) -> Vec<Facet> {
    let by_face = |items: &mut Vec<(u32, u32)>| items.sort_unstable();
    let mut triangles: Vec<(u32, u32)> = faces.of.iter().copied().zip(0..).collect();
    by_face(&mut triangles);
    let mut sides: Vec<(u32, u32)> = Vec::new();
    for (number, border) in (0..).zip(&borders.list) {
        sides.extend(border.faces_once().map(|face| (face, number)));
    }
    by_face(&mut sides);
    let mut sides = &sides[..];
    let chunks = triangles.chunk_by(|first, second| first.0 == second.0);
    chunks
        .map(|own| {
            let face = own[0].0;
            let (its, others) = sides.split_at(sides.partition_point(|it| it.0 == face));
            sides = others;
            let corners = own.iter().map(|it| topology.triangles[it.1 as usize]);
            let its = its.iter().map(|it| &borders.list[it.1 as usize]);
            let plane = Plane::of(topology, faces.normals[face as usize], corners.clone());
            plane.facet(topology, face, corners, its)
        })
        .collect()
}

/// Plane of a face, with coordinate axes.
struct Plane {
    /// Origin \[m\].
    origin: DVec3,
    normal: DVec3,
    axes: [DVec3; 2],
}

impl Plane {
    /// Creates the plane with this normal through the mean height of the triangles.
    fn of(
        topology: &Topology,
        normal: DVec3,
        triangles: impl Iterator<Item = [u32; 3]> + Clone,
    ) -> Self {
        let place = |vertex: u32| topology.vertices[vertex as usize];
        let first = triangles.clone().next().map_or(DVec3::ZERO, |it| place(it[0]));
        let (mut sum, mut count) = (0.0, 0.0);
        for vertex in triangles.flatten() {
            sum += (place(vertex) - first).dot(normal);
            count += 1.0;
        }
        // A face of one triangle has the plane of that triangle.
        let height = if count > 3.0 { sum / count } else { 0.0 };
        // Starts from the coordinate axis that is most nearly perpendicular to the normal.
        let across = normal.abs();
        let helper = if across.x <= across.y.min(across.z) {
            DVec3::X
        } else if across.y <= across.z {
            DVec3::Y
        } else {
            DVec3::Z
        };
        let along = helper - normal.dot(helper) * normal;
        let axis_x = along / along.norm();
        Self { origin: first + height * normal, normal, axes: [axis_x, axis_x.cross(normal)] }
    }

    fn local(&self, offset: DVec3) -> DVec2 {
        DVec2::from_array(self.axes.map(|axis| offset.dot(axis)))
    }

    fn facet<'a>(
        &self,
        topology: &Topology,
        face: u32,
        triangles: impl Iterator<Item = [u32; 3]> + Clone,
        borders: impl Iterator<Item = &'a Border>,
    ) -> Facet {
        let place = |vertex: u32| self.local(topology.vertices[vertex as usize] - self.origin);
        let (mut min, mut max) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        for point in triangles.clone().flatten().map(place) {
            (min, max) = (min.min(point), max.max(point));
        }
        let (middle, half) = (0.5 * (min + max), 0.5 * (max - min));
        let place = |vertex: u32| place(vertex) - middle;
        let side = |border: &Border| {
            let ends = border.ends.map(place);
            let way = ends[1] - ends[0];
            let across = DVec2::new(way.y, -way.x) / way.dot(way).sqrt();
            let outward = border.outward_of(face);
            let is_that_way = across.dot(self.local(outward)) >= 0.0;
            Side::new(ends, if is_that_way { across } else { -across })
        };
        let [axis_x, axis_z] = self.axes;
        let center = self.origin + middle.x * axis_x + middle.y * axis_z;
        let (half_x, half_z) = (half.x, half.y);
        Facet {
            frame: Rectangle {
                center,
                axis_x,
                axis_z,
                normal: self.normal,
                half_x,
                half_z,
                is_open: false,
            },
            outline: Outline::new(
                borders.map(side).collect(),
                triangles.map(|corners| corners.map(place)).collect(),
            ),
        }
    }
}
