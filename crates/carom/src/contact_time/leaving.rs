//! The end of an overlap of two spheres.

use glam::DVec3;

use super::sphere_sphere::Approach;
use crate::norm::Norm;

/// Time \[s\] at which the centres of two spheres, whose relative velocity is constant, have parted to the distance
/// `radius` R; `None` if they do not move.
///
/// Larger root of `|r + v t| = R`, with b, c and D of
/// [`sphere_sphere_linear`](super::sphere_sphere_linear), in the form without cancellation:
///
/// ```text
/// t = (-b + √D) / v²  if b <= 0,    t = -c / (b + √D)  if b > 0
/// ```
///
/// A negative D is rounding, and counts as 0; so does a distance beyond R.
///
/// - `offset` r = x2 - x1 \[m\], `relative_velocity` v = v2 - v1 \[m/s\]
pub fn sphere_sphere_leaving(offset: DVec3, relative_velocity: DVec3, radius: f64) -> Option<f64> {
    let square = relative_velocity.length_squared();
    if square == 0.0 {
        return None;
    }
    let approach = Approach::of(offset.into(), relative_velocity.into(), radius);
    let root = approach.discriminant.max(0.0).sqrt();
    let (distance, closing) = (offset.norm(), approach.closing);
    let time = if closing > 0.0 {
        (radius - distance) * (radius + distance) / (closing + root)
    } else {
        (root - closing) / square
    };
    Some(time.max(0.0))
}
