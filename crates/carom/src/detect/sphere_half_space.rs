use glam::DVec3;

use super::Separation;

/// Separation of a half-space and a sphere, `(x - p) · n - r`.
///
/// - `plane`: a point p \[m\] of its surface, and the unit normal n out of it
/// - `center`, `radius` \[m\] of the sphere
pub fn sphere_half_space(plane: (DVec3, DVec3), center: DVec3, radius: f64) -> Separation {
    let (point, normal) = plane;
    let height = (center - point).dot(normal);
    Separation { distance: height - radius, normal, point: center - height * normal }
}
