//! Directions of friction in a contact.

use glam::DVec3;

/// Returns two unit vectors across a unit normal and each other.
///
/// In the plane z = 0 one of them lies in the plane and the other one across it, so that forces of friction in the plane
/// have no rounded component out of it.
pub(crate) fn tangents(normal: DVec3) -> [DVec3; 2] {
    let is_in_plane = normal.z == 0.0;
    let first = if is_in_plane { DVec3::NEG_Z } else { normal.any_orthonormal_vector() };
    [first, normal.cross(first)]
}
