//! Faces, edges and corners of a mesh, each with where it is nearest.

mod borders;
mod corners;
mod faces;
mod facets;

use super::topology::Topology;
use super::{Corner, Edge, Facet};

use borders::Borders;
use faces::Faces;

/// What spheres meet of a mesh, in its own frame. A flat face counts where a foot falls on it, an edge beyond
/// the faces beside it, a corner beyond the edges that end there; so what a sphere touches first is one of them.
#[derive(Debug)]
pub(crate) struct Features {
    /// Facing as their triangles do.
    pub facets: Vec<Facet>,
    pub edges: Vec<Edge>,
    pub corners: Vec<Corner>,
    /// Whether faces are met from behind, too.
    pub is_two_sided: bool,
}

impl Features {
    /// Of a mesh that is met from one side, or from both unless it is closed.
    pub(in crate::mesh) fn of(topology: &Topology, is_one_sided: bool) -> Self {
        let is_two_sided = !(is_one_sided || topology.is_closed);
        let faces = Faces::of(topology);
        let borders = Borders::of(topology, &faces);
        Self {
            facets: facets::facets(&faces, topology, &borders),
            edges: borders.edges(topology, &faces, is_two_sided),
            corners: corners::corners(topology, &faces, &borders, is_two_sided),
            is_two_sided,
        }
    }
}
