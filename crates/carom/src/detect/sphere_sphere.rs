use glam::DVec3;

use super::Separation;

/// Normal of two spheres with coincident centres: any direction will do, if it is always the same.
const NORMAL_OF_COINCIDENT_CENTERS: DVec3 = DVec3::Y;

/// Separation of two spheres, `|x2 - x1| - (r1 + r2)`; also of a fixed sphere 1 and a sphere 2.
///
/// - `centers` \[m\], `radii` \[m\] of spheres 1 and 2
pub fn sphere_sphere(centers: [DVec3; 2], radii: [f64; 2]) -> Separation {
    let offset = centers[1] - centers[0];
    let length = offset.dot(offset).sqrt();
    let normal = if length > 0.0 { offset / length } else { NORMAL_OF_COINCIDENT_CENTERS };
    Separation {
        distance: length - (radii[0] + radii[1]),
        normal,
        point: centers[0] + radii[0] * normal,
    }
}
