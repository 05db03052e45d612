//! Passages of spheres through surfaces that are open from behind.

use glam::DVec3;

use super::{Separation, sphere_surface};
use crate::surface::{Form, Surface};

/// Overlap with the front of an open surface, as a part of the radius, beyond which a sphere came from behind: from
/// the front none sinks in as deep.
const DEEP: f64 = 1e-3;

/// Whether a sphere with this separation from the front of a surface came from behind it and is still on its way
/// through. Such a sphere passes to either side.
///
/// - `radius` \[m\] of the sphere
pub(crate) fn is_passing(form: &Form, separation: &Separation, radius: f64) -> bool {
    form.is_open() && is_deep(separation.distance, radius)
}

/// Whether an overlap with an open surface is that of a sphere from behind.
///
/// - `distance` \[m\] of the surfaces, negative where they overlap; `radius` \[m\] of the sphere
pub(crate) fn is_deep(distance: f64, radius: f64) -> bool {
    distance < -DEEP * radius
}

/// Where spheres began a frame, for rules that find at its end what they meet.
#[derive(Clone, Copy)]
pub(crate) struct FrameStart<'a> {
    /// Centres \[m\].
    pub centers: &'a [DVec3],
}

impl FrameStart<'_> {
    /// Whether a sphere with this radius \[m\] passes an open surface in the frame: it began the frame behind it, or
    /// within a surface at rest, which it came into from behind. One that moves may also have overlapped it by moving.
    pub fn passes(&self, sphere: usize, radius: f64, surface: &Surface) -> bool {
        if !surface.form.is_open() {
            return false;
        }
        let is_at_rest = surface.course.is_none() && surface.motion.is_at_rest();
        let separation = sphere_surface(&surface.form, self.centers[sphere], radius);
        separation.is_none_or(|it| is_at_rest && is_deep(it.distance, radius))
    }
}
