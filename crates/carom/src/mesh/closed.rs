//! Closed meshes as solids.

use glam::{DQuat, DVec3};

use super::{Depth, Mesh};

/// Volume enclosed by a closed mesh, in the coordinates of the world.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct ClosedMesh {
    pub(super) mesh: Mesh,
    /// Origin of the coordinates of the mesh \[m\].
    pub(super) position: DVec3,
    /// Rotation from the coordinates of the mesh to those of the world, of unit length.
    pub(super) rotation: DQuat,
}

impl ClosedMesh {
    /// Creates the volume of a mesh in its own coordinates; `None` if the mesh is not closed.
    pub fn of(mesh: &Mesh) -> Option<Self> {
        let (position, rotation) = (DVec3::ZERO, DQuat::IDENTITY);
        mesh.is_closed().then(|| Self { mesh: mesh.clone(), position, rotation })
    }

    /// Returns the depth of a point \[m\] in the volume; `None` outside.
    pub fn depth_at(&self, point: DVec3) -> Option<Depth> {
        let local = self.rotation.conjugate() * (point - self.position);
        let depth = self.mesh.depth_at(local)?;
        Some(Depth { normal: self.rotation * depth.normal, ..depth })
    }

    /// Returns the bounding box along the axes of the mesh: its centre \[m\], these axes, and half its size along
    /// them \[m\].
    pub fn box_about(&self) -> (DVec3, [DVec3; 3], DVec3) {
        let [min, max] = self.mesh.bounds();
        let axes = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| self.rotation * axis);
        let center = self.position + self.rotation * (0.5 * (min + max));
        (center, axes, 0.5 * (max - min))
    }
}
