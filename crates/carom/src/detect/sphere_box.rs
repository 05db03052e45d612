use glam::DVec3;

use super::Separation;
use crate::surface::SolidBox;

/// Separation of a solid box and a sphere.
///
/// With l the centre in the box's frame and q the point of the box nearest to it: `|l - q| - r`
/// outside. Inside, the nearest face counts: minus its distance, minus r, along its normal.
///
/// - `center`, `radius` \[m\] of the sphere
pub(crate) fn sphere_box(solid: &SolidBox, center: DVec3, radius: f64) -> Separation {
    let offset = center - solid.center;
    let local = DVec3::from_array(solid.axes.map(|axis| offset.dot(axis)));
    let world =
        |local: DVec3| local.x * solid.axes[0] + local.y * solid.axes[1] + local.z * solid.axes[2];
    let depths = solid.half - local.abs();
    if depths.min_element() < 0.0 {
        let nearest = solid.center + world(local.clamp(-solid.half, solid.half));
        return Separation::from_point(nearest, center, radius, solid.axes[1]);
    }
    let axis = depths.min_position();
    let normal = if local[axis] < 0.0 { -solid.axes[axis] } else { solid.axes[axis] };
    let depth = depths[axis];
    Separation { distance: -depth - radius, normal, point: center + depth * normal }
}
