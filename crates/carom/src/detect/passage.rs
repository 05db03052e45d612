//! Passages of spheres through surfaces that are open from behind.

use glam::DVec3;

use super::surface_tree::SurfaceTree;
use super::{Separation, sphere_surface};
use crate::bounds::Bounds;
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

/// Whether a centre is behind an open surface, where that is in its way: behind a face of a mesh or beyond a border of
/// one, by less than the radius, since other faces may have their front farther behind.
///
/// - `center`, `radius` \[m\] of the sphere
pub(crate) fn is_behind(form: &Form, center: DVec3, radius: f64) -> bool {
    match form {
        Form::Facet(facet) => {
            let height = facet.height_of(center);
            form.is_open() && -radius < height && height < 0.0 && facet.is_under(center)
        }
        Form::Edge(edge) => form.is_open() && edge.is_seen_from_behind(center, radius),
        Form::Corner(_) => false,
        _ => form.is_open() && sphere_surface(form, center, radius).is_none(),
    }
}

/// Where spheres began a frame, for rules that find at its end what they meet.
#[derive(Clone, Copy)]
pub(crate) struct FrameStart<'a> {
    /// Centres \[m\].
    pub centers: &'a [DVec3],
}

impl FrameStart<'_> {
    /// Whether a sphere passes an open surface in the frame: it began the frame behind it, or within a surface at rest,
    /// which it came into from behind. One that moves may also have overlapped it by moving. A sphere passes a mesh as a
    /// whole.
    ///
    /// - `radius` \[m\] of the sphere
    /// - `surfaces` of the world, with their tree
    pub fn passes(
        &self,
        sphere: usize,
        radius: f64,
        surface: &Surface,
        (surfaces, tree): (&[Surface], &SurfaceTree),
    ) -> bool {
        if !surface.form.is_open() {
            return false;
        }
        let center = self.centers[sphere];
        if !surface.form.is_feature() {
            return began_within(surface, center, radius);
        }
        let mut near = Vec::new();
        tree.near(&Bounds::around(center, DVec3::splat(radius)), &mut near);
        let parts = near.iter().map(|&it| &surfaces[it as usize]);
        let mut parts = parts.filter(|it| it.collider == surface.collider && it.form.is_open());
        parts.any(|it| began_within(it, center, radius))
    }
}

/// Whether a sphere that began a frame here is on its way through an open surface.
fn began_within(surface: &Surface, center: DVec3, radius: f64) -> bool {
    let form = &surface.form;
    let is_at_rest = surface.course.is_none() && surface.motion.is_at_rest();
    let is_within = || {
        let separation = sphere_surface(form, center, radius);
        is_at_rest && separation.is_some_and(|it| is_passing(form, &it, radius))
    };
    is_behind(form, center, radius) || is_within()
}
