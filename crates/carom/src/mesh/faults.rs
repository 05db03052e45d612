//! What of a mesh may not be as meant.

use super::topology::Topology;

/// Probable mistakes in a mesh, by the numbers of its triangles and vertices, from 0. A mesh with faults is met
/// as it is.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct MeshFaults {
    /// Triangles without an area, which are left out.
    pub degenerate: Vec<usize>,
    /// Triangles of the same three places as one before, which are left out.
    pub repeated: Vec<usize>,
    /// Triangles that face otherwise than a neighbour across an edge does; of two, the one with the higher
    /// number.
    pub flipped: Vec<usize>,
    /// Edges of one triangle only, by their vertices: holes, and the rim of an open mesh.
    pub open_edges: Vec<[usize; 2]>,
    /// Edges of more than two triangles, by their vertices.
    pub crowded_edges: Vec<[usize; 2]>,
}

impl MeshFaults {
    pub(super) fn of(topology: &Topology) -> Self {
        let mut faults = Self {
            degenerate: topology.degenerate.clone(),
            repeated: topology.repeated.clone(),
            ..Self::default()
        };
        for edge in topology.edges() {
            let ends = edge.ends.map(|it| it as usize);
            match edge.uses {
                [_] => faults.open_edges.push(ends),
                [first, second] if first.is_forward == second.is_forward => {
                    let later = first.triangle.max(second.triangle) as usize;
                    faults.flipped.push(topology.numbers[later] as usize);
                }
                [_, _] => {}
                _ => faults.crowded_edges.push(ends),
            }
        }
        faults.flipped.sort_unstable();
        faults.flipped.dedup();
        faults
    }
}
