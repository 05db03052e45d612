use glam::DVec3;

use super::Separation;
use crate::surface::Rectangle;

/// Separation of a one-sided rectangle and a sphere: `|l - q| - r`, where l is the centre in the
/// rectangle's frame and q the point of the rectangle nearest to it.
///
/// The normal is the rectangle's own where l is above its inside; towards l from the edge or
/// corner where q lies on one. `None` where the centre is behind the rectangle (`l.y < 0`):
/// from underneath nothing collides.
///
/// - `center`, `radius` \[m\] of the sphere
pub(crate) fn sphere_rectangle(
    rectangle: &Rectangle,
    center: DVec3,
    radius: f64,
) -> Option<Separation> {
    let height = (center - rectangle.center).dot(rectangle.normal);
    (height >= 0.0).then(|| sphere_rectangle_known_in_front(rectangle, center, radius))
}

/// Separation of a rectangle and a sphere that is known to be in front of it, whatever rounding says.
pub(crate) fn sphere_rectangle_known_in_front(
    rectangle: &Rectangle,
    center: DVec3,
    radius: f64,
) -> Separation {
    let offset = center - rectangle.center;
    let height = offset.dot(rectangle.normal);
    let (x, z) = (offset.dot(rectangle.axis_x), offset.dot(rectangle.axis_z));
    let nearest_x = x.clamp(-rectangle.half_x, rectangle.half_x);
    let nearest_z = z.clamp(-rectangle.half_z, rectangle.half_z);
    let point = rectangle.center + nearest_x * rectangle.axis_x + nearest_z * rectangle.axis_z;
    if nearest_x == x && nearest_z == z {
        let normal = rectangle.normal;
        return Separation { distance: height - radius, normal, point };
    }
    Separation::from_point(point, center, radius, rectangle.normal)
}
