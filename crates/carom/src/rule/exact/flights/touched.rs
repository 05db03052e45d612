//! Surfaces that spheres on curves touch.

use glam::DVec3;

use super::moving_surface::MovingSurface;
use crate::surface::Form;

/// A surface that a sphere touches.
pub(super) struct Touched<'a> {
    /// Place of its cluster.
    pub cluster: usize,
    /// Place of the sphere.
    pub sphere: usize,
    /// Shift from the centre of the sphere to its image beside the surface \[m\].
    pub shift: DVec3,
    /// Where the system says that it is.
    pub form: &'a Form,
    pub moving: Option<MovingSurface<'a>>,
    /// Whether the sphere is on a ring of the surface.
    pub is_on_ring: bool,
}
