//! Closed meshes as solids.

use glam::{DQuat, DVec3};

use super::{Depth, Mesh};

/// What a closed mesh encloses, in the world.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct ClosedMesh {
    pub(super) mesh: Mesh,
    /// Of the origin of its frame \[m\].
    pub(super) position: DVec3,
    /// From its frame to the world, of unit length.
    pub(super) rotation: DQuat,
}

impl ClosedMesh {
    /// Of a mesh in its own frame; `None` of one that is not closed.
    pub fn of(mesh: &Mesh) -> Option<Self> {
        let (position, rotation) = (DVec3::ZERO, DQuat::IDENTITY);
        mesh.is_closed().then(|| Self { mesh: mesh.clone(), position, rotation })
    }

    /// How deep a point \[m\] is inside; `None` outside.
    pub fn depth_at(&self, point: DVec3) -> Option<Depth> {
        let local = self.rotation.conjugate() * (point - self.position);
        let depth = self.mesh.depth_at(local)?;
        Some(Depth { normal: self.rotation * depth.normal, ..depth })
    }

    /// The middle \[m\] of the smallest box about it along the axes of its frame, these axes, and half of the size of
    /// the box along them \[m\].
    pub fn box_about(&self) -> (DVec3, [DVec3; 3], DVec3) {
        let [min, max] = self.mesh.bounds();
        let axes = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| self.rotation * axis);
        let center = self.position + self.rotation * (0.5 * (min + max));
        (center, axes, 0.5 * (max - min))
    }
}
