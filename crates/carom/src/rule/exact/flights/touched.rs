//! Surfaces that spheres on curves touch.

use glam::DVec3;

use crate::surface::Form;

/// A surface at rest that a sphere touches.
pub(super) struct Touched<'a> {
    /// Place of its cluster.
    pub cluster: usize,
    /// Place of the sphere.
    pub sphere: usize,
    /// Shift from the centre of the sphere to its image beside the surface \[m\].
    pub shift: DVec3,
    pub form: &'a Form,
    /// Whether the sphere is on a ring of the surface.
    pub is_on_ring: bool,
}
