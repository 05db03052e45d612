//! Neighbours among the triangles of a mesh, and the flat faces that they form.

use glam::DVec3;

use super::weld;
use crate::connected::Connected;
use crate::norm::Norm;

/// Largest angle between the normals of neighbours that form one face \[rad\].
pub(super) const FLAT: f64 = 1e-9;

/// Triangles of welded vertices, without those with zero area.
#[derive(Debug, Clone)]
pub(super) struct Topology {
    /// Positions of the vertices \[m\].
    pub vertices: Vec<DVec3>,
    /// Indices of welded vertices.
    pub triangles: Vec<[u32; 3]>,
    /// Index of each triangle among the given ones.
    pub numbers: Vec<u32>,
    /// Twice the area of each triangle along its unit normal \[m²\].
    pub areas: Vec<DVec3>,
    /// Given triangles with zero area.
    pub degenerate: Vec<usize>,
    /// Given triangles that repeat earlier ones.
    pub repeated: Vec<usize>,
    /// Sides of triangles, ascending by their vertices.
    uses: Vec<EdgeUse>,
    pub is_closed: bool,
}

/// A side of a triangle.
#[derive(Debug, Clone, Copy)]
pub(super) struct EdgeUse {
    /// Indices of its vertices, ascending.
    pub ends: [u32; 2],
    pub triangle: u32,
    /// Whether the triangle goes from the first end to the second.
    pub is_forward: bool,
}

/// An edge with all triangles at it.
pub(super) struct EdgeUses<'a> {
    pub ends: [u32; 2],
    pub uses: &'a [EdgeUse],
}

impl Topology {
    pub fn of(vertices: &[DVec3], given: &[[u32; 3]]) -> Self {
        let tolerance = weld::tolerance(vertices);
        let first_of = weld::weld(vertices, tolerance);
        let mut topology = Self {
            vertices: vertices.to_vec(),
            triangles: Vec::with_capacity(given.len()),
            numbers: Vec::with_capacity(given.len()),
            areas: Vec::with_capacity(given.len()),
            degenerate: Vec::new(),
            repeated: Vec::new(),
            uses: Vec::new(),
            is_closed: false,
        };
        let repeated = repeated(given, &first_of);
        for (number, corners) in given.iter().enumerate() {
            let corners = corners.map(|it| first_of[it as usize]);
            let [a, b, c] = corners.map(|it| vertices[it as usize]);
            let area = (b - a).cross(c - a);
            let longest = [b - a, c - b, a - c].map(DVec3::norm).into_iter().fold(0.0, f64::max);
            // A triangle less high than the welding tolerance has zero area.
            if area.norm() <= tolerance * longest {
                topology.degenerate.push(number);
            } else if repeated[number] {
                topology.repeated.push(number);
            } else {
                topology.triangles.push(corners);
                topology.numbers.push(number as u32);
                topology.areas.push(area);
            }
        }
        topology.uses = uses_of(&topology.triangles);
        let is_paired = |it: EdgeUses| matches!(it.uses, [first, second] if first.is_forward != second.is_forward);
        let is_closed = topology.edges().all(is_paired);
        topology.is_closed = is_closed;
        topology
    }

    /// Returns all edges, ascending by their vertices.
    pub fn edges(&self) -> impl Iterator<Item = EdgeUses<'_>> {
        let edges = self.uses.chunk_by(|first, second| first.ends == second.ends);
        edges.map(|uses| EdgeUses { ends: uses[0].ends, uses })
    }

    /// Returns the index of the flat face of each triangle, and the number of faces.
    pub fn faces(&self) -> (Vec<u32>, usize) {
        let mut connected = Connected::new(self.triangles.len());
        for edge in self.edges() {
            let [first, second] = edge.uses else { continue };
            let [a, b] = [first, second].map(|it| self.areas[it.triangle as usize]);
            let is_alike = first.is_forward != second.is_forward;
            if is_alike && a.dot(b) > 0.0 && a.cross(b).norm() <= FLAT * a.norm() * b.norm() {
                connected.join(first.triangle as usize, second.triangle as usize);
            }
        }
        let (mut face_of, mut count) = (Vec::with_capacity(self.triangles.len()), 0);
        for triangle in 0..self.triangles.len() {
            // Faces are numbered by their first triangles.
            let root = connected.root_of(triangle);
            if root == triangle {
                face_of.push(count);
                count += 1;
            } else {
                face_of.push(face_of[root]);
            }
        }
        (face_of, count as usize)
    }
}

/// Returns which triangles repeat an earlier one, in any orientation.
fn repeated(given: &[[u32; 3]], first_of: &[u32]) -> Vec<bool> {
    let mut sorted: Vec<([u32; 3], usize)> = (given.iter().enumerate())
        .map(|(number, corners)| {
            let mut corners = corners.map(|it| first_of[it as usize]);
            corners.sort_unstable();
            (corners, number)
        })
        .collect();
    sorted.sort_unstable();
    let mut repeated = vec![false; given.len()];
    for pair in sorted.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
        repeated[pair[1].1] = true;
    }
    repeated
}

fn uses_of(triangles: &[[u32; 3]]) -> Vec<EdgeUse> {
    let mut uses: Vec<EdgeUse> = Vec::with_capacity(3 * triangles.len());
    for (triangle, corners) in triangles.iter().enumerate() {
        for side in 0..3 {
            let [from, to] = [corners[side], corners[(side + 1) % 3]];
            let (ends, is_forward) = ([from.min(to), from.max(to)], from < to);
            uses.push(EdgeUse { ends, triangle: triangle as u32, is_forward });
        }
    }
    uses.sort_unstable_by_key(|it| (it.ends, it.triangle));
    uses
}
