//! Computes the faces, edges and corners of a mesh, and the regions in which each is nearest.

mod borders;
mod corners;
mod faces;
mod facets;

use super::topology::Topology;
use super::{Corner, Edge, Facet};

use borders::Borders;
use faces::Faces;

/// Features of a mesh that spheres meet, in the coordinates of the mesh. A face counts for points above it, an edge
/// for points beyond its faces, a corner for points beyond its edges. So the part of the mesh that a sphere touches
/// first is always one of them.
#[derive(Debug)]
pub(crate) struct Features {
    /// Faces, which face the same side as their triangles.
    pub facets: Vec<Facet>,
    pub edges: Vec<Edge>,
    pub corners: Vec<Corner>,
    /// Whether faces are also met from behind.
    pub is_two_sided: bool,
}

impl Features {
    /// Number of surfaces that they make; faces met from both sides are two.
    pub fn count(&self) -> usize {
        let sides = if self.is_two_sided { 2 } else { 1 };
        sides * self.facets.len() + self.edges.len() + self.corners.len()
    }

    /// Computes the features of a mesh, met from both sides if it is neither closed nor one-sided.
    pub(in crate::mesh) fn of(topology: &Topology, is_one_sided: bool) -> Self {
        let is_two_sided = !(is_one_sided || topology.is_closed);
        let faces = Faces::of(topology);
        let borders = Borders::of(topology, &faces);
        let mut features = Self {
            facets: facets::facets(&faces, topology, &borders),
            edges: borders.edges(topology, &faces, is_two_sided),
            corners: corners::corners(topology, &faces, &borders, is_two_sided),
            is_two_sided,
        };
        features.open(is_one_sided && !topology.is_closed);
        features
    }

    /// Sets whether spheres pass all of them from behind.
    fn open(&mut self, is_open: bool) {
        self.facets.iter_mut().for_each(|it| it.frame.is_open = is_open);
        self.edges.iter_mut().for_each(|it| it.is_open = is_open);
        self.corners.iter_mut().for_each(|it| it.is_open = is_open);
    }
}
