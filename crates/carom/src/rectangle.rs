//! One-sided rectangles.

use glam::DVec3;

/// A one-sided rectangle in the world. The three axes are orthonormal.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Rectangle {
    pub center: DVec3,
    /// Direction of the first pair of edges.
    pub axis_x: DVec3,
    /// Direction of the second pair of edges.
    pub axis_z: DVec3,
    /// Direction the front faces.
    pub normal: DVec3,
    /// Half the length along `axis_x` \[m\].
    pub half_x: f64,
    /// Half the length along `axis_z` \[m\].
    pub half_z: f64,
    /// Whether spheres pass it from behind: nothing else of its collider is there.
    pub is_open: bool,
}

impl Rectangle {
    /// A rectangle in its place that faces the other way.
    pub fn turned(self) -> Self {
        Self { normal: -self.normal, ..self }
    }
}
