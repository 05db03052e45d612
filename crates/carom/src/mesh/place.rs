//! Moves features to other places.

use glam::{DQuat, DVec3};

use super::{ClosedMesh, Corner, Edge, Facet};
use crate::rectangle::Rectangle;
use crate::rotation;

/// A rotation about a point followed by a shift: `x' = to + R (x - from)`. Components that are rounding of the turn are zero.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Placement {
    /// Rotation, of unit length.
    pub rotation: DQuat,
    /// Centre of the rotation \[m\].
    pub from: DVec3,
    /// Position of that centre afterwards \[m\].
    pub to: DVec3,
}

impl Placement {
    pub fn point(&self, point: DVec3) -> DVec3 {
        self.to + rotation::turned_offset(self.rotation, point - self.from)
    }

    /// Where a point was before.
    pub fn point_back(&self, point: DVec3) -> DVec3 {
        self.from + self.vector_back(point - self.to)
    }

    /// A vector as it was before the rotation.
    pub fn vector_back(&self, vector: DVec3) -> DVec3 {
        rotation::turned_offset(self.rotation.conjugate(), vector)
    }

    pub fn direction(&self, direction: DVec3) -> DVec3 {
        rotation::turned_direction(self.rotation, direction)
    }

    pub fn rectangle(&self, it: &Rectangle) -> Rectangle {
        Rectangle {
            center: self.point(it.center),
            axis_x: self.direction(it.axis_x),
            axis_z: self.direction(it.axis_z),
            normal: self.direction(it.normal),
            ..*it
        }
    }

    pub fn facet(&self, it: &Facet) -> Facet {
        Facet { frame: self.rectangle(&it.frame), outline: it.outline.clone() }
    }

    pub fn closed_mesh(&self, it: &ClosedMesh) -> ClosedMesh {
        ClosedMesh {
            mesh: it.mesh.clone(),
            position: self.point(it.position),
            rotation: self.rotation * it.rotation,
        }
    }

    pub fn edge(&self, it: &Edge) -> Edge {
        Edge {
            center: self.point(it.center),
            axis: self.direction(it.axis),
            half: it.half,
            outward: it.outward.map(|direction| self.direction(direction)),
            is_border: it.is_border,
            is_open: it.is_open,
        }
    }

    pub fn corner(&self, it: &Corner) -> Corner {
        Corner {
            point: self.point(it.point),
            rotation: self.rotation * it.rotation,
            rays: it.rays.clone(),
            is_open: it.is_open,
        }
    }
}
