//! Boxes in the world: solid ones, and the walls of containers.

use glam::DVec3;

use crate::collider::Sides;
use crate::mesh::ClosedMesh;
use crate::norm::Norm;
use crate::rectangle::Rectangle;

/// A solid box in the world.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct SolidBox {
    pub center: DVec3,
    /// Directions of its edges, orthonormal.
    pub axes: [DVec3; 3],
    /// Half the lengths along the axes \[m\].
    pub half: DVec3,
}

impl SolidBox {
    /// The smallest one about a closed mesh along the axes of its frame.
    pub fn about(mesh: &ClosedMesh) -> Self {
        let (center, axes, half) = mesh.box_about();
        Self { center, axes, half }
    }

    /// Returns a bound of the coordinates of the box \[m\].
    pub fn coordinates(&self) -> f64 {
        self.center.norm() + self.half.element_sum()
    }

    /// Height of its highest point above a plane, which is given by a point \[m\] and its normal.
    pub fn height_above(&self, [point, normal]: [DVec3; 2]) -> f64 {
        let rises = self.axes.map(|axis| axis.dot(normal).abs());
        (self.center - point).dot(normal) + self.half.dot(DVec3::from_array(rises))
    }

    /// The faces that are not open, outward.
    pub fn walls(&self, open: Sides) -> impl Iterator<Item = Rectangle> {
        let faces = self.faces().into_iter().zip(open.to_array());
        faces.filter_map(|(face, is_open)| (!is_open).then_some(face))
    }

    /// The six faces, outward.
    pub fn faces(&self) -> [Rectangle; 6] {
        std::array::from_fn(|number| {
            let axis = number / 2;
            let (first, second) = [(1, 2), (0, 2), (0, 1)][axis];
            let normal = if number % 2 == 0 { -self.axes[axis] } else { self.axes[axis] };
            Rectangle {
                center: self.center + self.half[axis] * normal,
                axis_x: self.axes[first],
                axis_z: self.axes[second],
                normal,
                half_x: self.half[first],
                half_z: self.half[second],
                is_open: false,
            }
        })
    }
}
