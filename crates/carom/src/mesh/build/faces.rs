//! Groups the triangles of a mesh into flat faces.

use glam::DVec3;

use crate::mesh::topology::Topology;
use crate::norm::Norm;

/// The flat face of each triangle.
pub(super) struct Faces {
    /// Index of the face of each triangle.
    pub of: Vec<u32>,
    /// Unit normal of each face.
    pub normals: Vec<DVec3>,
}

impl Faces {
    pub fn of(topology: &Topology) -> Self {
        let (of, count) = topology.faces();
        let mut normals = vec![DVec3::ZERO; count];
        for (&face, &area) in of.iter().zip(&topology.areas) {
            normals[face as usize] += area;
        }
        normals.iter_mut().for_each(|normal| *normal /= normal.norm());
        Self { of, normals }
    }
}
