//! Borders of faces: the edges of a mesh that are not inside a flat face.

use glam::DVec3;

use super::faces::Faces;
use crate::connected::Connected;
use crate::mesh::Edge;
use crate::mesh::topology::{EdgeUses, FLAT, Topology};
use crate::norm::Norm;

/// A straight border of faces.
#[derive(Debug, Clone)]
pub(super) struct Border {
    /// Indices of its vertices.
    pub ends: [u32; 2],
    /// The faces at this border, ascending, each with the unit vector across the border that points away from it.
    sides: Vec<(u32, DVec3)>,
}

/// Products of unit vectors below this are zero up to rounding.
const BESIDE: f64 = 1e-12;

impl Border {
    /// Returns the faces that have the border as a side an odd number of times.
    pub fn faces_once(&self) -> impl Iterator<Item = u32> {
        let chunks = self.sides.chunk_by(|first, second| first.0 == second.0);
        chunks.filter(|chunk| chunk.len() % 2 == 1).map(|chunk| chunk[0].0)
    }

    /// Returns the unit vector across the border that points away from a face.
    pub fn outward_of(&self, face: u32) -> DVec3 {
        let side = self.sides.iter().find(|side| side.0 == face);
        side.map_or(DVec3::ZERO, |side| side.1)
    }

    fn has_faces_of(&self, other: &Self) -> bool {
        self.sides.iter().map(|it| it.0).eq(other.sides.iter().map(|it| it.0))
    }

    /// Returns two directions away from faces: points beyond both are nearer to the border than to the faces.
    /// `None` if there are no such points, or only behind one-sided faces.
    fn outward(&self, faces: &Faces, is_two_sided: bool) -> Option<[DVec3; 2]> {
        let normal = |face: u32| faces.normals[face as usize];
        match *self.sides {
            [(face, outward)] => Some([outward, if is_two_sided { outward } else { normal(face) }]),
            [(first, one), (_, other)] => {
                let is_flat = (one + other).norm() <= FLAT;
                let is_convex = normal(first).dot(other) > 0.0;
                (!is_flat && (is_two_sided || is_convex)).then_some([one, other])
            }
            _ => self.wedge(),
        }
    }

    /// Returns the two directions across the border that bound the points beyond all directions.
    fn wedge(&self) -> Option<[DVec3; 2]> {
        let directions = || self.sides.iter().map(|side| side.1);
        let axis = directions().find_map(|it| {
            let axis = directions().map(|other| it.cross(other)).find(|axis| axis.norm() > FLAT)?;
            Some(axis / axis.norm())
        })?;
        let is_beyond = |ray: DVec3| directions().all(|it| ray.dot(it) >= -BESIDE);
        let limits: Vec<DVec3> = directions()
            .filter(|it| is_beyond(axis.cross(*it)) || is_beyond(-axis.cross(*it)))
            .collect();
        let first = *limits.first()?;
        let other = limits.iter().copied().find(|it| (*it - first).norm() > FLAT);
        let other = other.unwrap_or(first);
        ((first + other).norm() > FLAT).then_some([first, other])
    }
}

/// All borders of a mesh.
pub(super) struct Borders {
    pub list: Vec<Border>,
    /// For each vertex, whether a border ends there.
    pub is_end: Vec<bool>,
}

impl Borders {
    pub fn of(topology: &Topology, faces: &Faces) -> Self {
        let pieces: Vec<Border> =
            topology.edges().filter_map(|edge| border(topology, faces, &edge)).collect();
        let mut at_vertex: Vec<(u32, u32)> = Vec::with_capacity(2 * pieces.len());
        for (number, piece) in (0..).zip(&pieces) {
            at_vertex.extend(piece.ends.map(|end| (end, number)));
        }
        at_vertex.sort_unstable();
        let mut is_end = vec![false; topology.vertices.len()];
        let mut joined = Connected::new(pieces.len());
        for around in at_vertex.chunk_by(|first, second| first.0 == second.0) {
            let vertex = around[0].0;
            match *around {
                [(_, first), (_, second)]
                    if goes_on(
                        topology,
                        vertex,
                        [first, second].map(|it| &pieces[it as usize]),
                    ) =>
                {
                    joined.join(first as usize, second as usize);
                }
                _ => is_end[vertex as usize] = true,
            }
        }
        let mut ends: Vec<(usize, u32)> = Vec::new();
        for (number, piece) in pieces.iter().enumerate() {
            let own = piece.ends.into_iter().filter(|&end| is_end[end as usize]);
            ends.extend(own.map(|end| (joined.root_of(number), end)));
        }
        ends.sort_unstable();
        let whole = ends.chunk_by(|first, second| first.0 == second.0).filter_map(|ends| {
            let [(root, first), (_, second)] = *ends else { return None };
            Some(Border { ends: [first, second], sides: pieces[root].sides.clone() })
        });
        Self { list: whole.collect(), is_end }
    }

    /// Returns the borders that spheres can meet as edges.
    pub fn edges(&self, topology: &Topology, faces: &Faces, is_two_sided: bool) -> Vec<Edge> {
        let edge = |border: &Border| {
            let outward = border.outward(faces, is_two_sided)?;
            let [first, second] = border.ends.map(|it| topology.vertices[it as usize]);
            let (way, center) = (second - first, 0.5 * (first + second));
            let length = way.norm();
            let half = 0.5 * length;
            let is_border = border.sides.len() == 1;
            Some(Edge { center, axis: way / length, half, outward, is_border, is_open: false })
        };
        self.list.iter().filter_map(edge).collect()
    }
}

/// Converts an edge of the mesh to a border; `None` if it is inside a face.
fn border(topology: &Topology, faces: &Faces, edge: &EdgeUses) -> Option<Border> {
    let face = |triangle: u32| faces.of[triangle as usize];
    if let [first, second] = edge.uses
        && face(first.triangle) == face(second.triangle)
    {
        return None;
    }
    let place = |vertex: u32| topology.vertices[vertex as usize];
    let [from, to] = edge.ends.map(place);
    let axis = (to - from) / (to - from).norm();
    let side = |triangle: u32| {
        let corners = topology.triangles[triangle as usize].map(place);
        let across = axis.cross(faces.normals[face(triangle) as usize]);
        let across = across / across.norm();
        let inside: f64 = corners.iter().map(|corner| (*corner - from).dot(across)).sum();
        (face(triangle), if inside > 0.0 { -across } else { across })
    };
    let mut sides: Vec<(u32, DVec3)> = edge.uses.iter().map(|it| side(it.triangle)).collect();
    sides.sort_by_key(|side| side.0);
    Some(Border { ends: edge.ends, sides })
}

/// Returns whether two borders that meet at a vertex form one straight line between the same faces.
fn goes_on(topology: &Topology, vertex: u32, borders: [&Border; 2]) -> bool {
    let place = |vertex: u32| topology.vertices[vertex as usize];
    let ways = borders.map(|border| {
        let [first, second] = border.ends;
        place(if first == vertex { second } else { first }) - place(vertex)
    });
    let is_straight = ways[0].dot(ways[1]) < 0.0
        && ways[0].cross(ways[1]).norm() <= FLAT * ways[0].norm() * ways[1].norm();
    is_straight && borders[0].has_faces_of(borders[1])
}
