//! Coulomb's law for one contact: the slip that friction opposes, and the largest impulse.

use glam::DVec3;

/// Slip of the surfaces of two bodies at their contact: the tangential part of their relative velocity, with the sum of
/// their spins.
pub(crate) fn slip(velocity: DVec3, normal: DVec3, spin: DVec3) -> DVec3 {
    velocity - normal * velocity.dot(normal) - spin.cross(normal)
}

/// Returns a vector, shortened to a length if it is longer.
pub(crate) fn limited(vector: DVec3, most: f64) -> DVec3 {
    let length = vector.dot(vector).sqrt();
    if length > most { vector * (most / length) } else { vector }
}
