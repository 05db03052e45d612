//! Probable mistakes in a mesh.

use super::topology::Topology;

/// Probable mistakes in a mesh, by the indices of its triangles and vertices. They change nothing in how spheres
/// meet the mesh.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct MeshFaults {
    /// Triangles with zero area, which are left out.
    pub degenerate: Vec<usize>,
    /// Triangles with the same three vertices as an earlier one, which are left out.
    pub repeated: Vec<usize>,
    /// Triangles whose orientation differs from that of a neighbour; of two neighbours, the one with the higher
    /// index.
    pub flipped: Vec<usize>,
    /// Edges that belong to one triangle only, as pairs of vertices: holes, and the rim of an open mesh.
    pub open_edges: Vec<[usize; 2]>,
    /// Edges that belong to more than two triangles, as pairs of vertices.
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
