//! Continued rotations, and axes that are turned.

use glam::{DQuat, DVec3};

/// A rotation after `h` \[s\] with an angular velocity \[rad/s\]: `exp(h w / 2) q`, of length 1 where it turns.
pub(crate) fn turned(rotation: DQuat, angular_velocity: DVec3, h: f64) -> DQuat {
    let turn = angular_velocity * h;
    let angle = turn.dot(turn).sqrt();
    if angle > 0.0 {
        let (sine, cosine) = libm::sincos(0.5 * angle);
        let axis = turn / angle;
        DQuat::from_xyzw(axis.x * sine, axis.y * sine, axis.z * sine, cosine) * rotation.normalize()
    } else {
        rotation
    }
}

/// Components of a turned axis up to this size are rounding.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// The axes of a local frame in the world, for a rotation of length 1.
///
/// Components of the size of rounding are zero: after a quarter turn an axis is parallel to one of the world, so that
/// a sphere that starts in a plane of symmetry stays in it.
pub(crate) fn axes(rotation: DQuat) -> [DVec3; 3] {
    DVec3::AXES.map(|axis| without_rounding(rotation * axis))
}

/// A turned unit vector without the components that are rounding.
fn without_rounding(axis: DVec3) -> DVec3 {
    let is_rounding = axis.abs().cmple(DVec3::splat(ROUNDING));
    if (is_rounding & axis.cmpne(DVec3::ZERO)).any() {
        let parallel = DVec3::select(is_rounding, DVec3::ZERO, axis);
        parallel / parallel.length()
    } else {
        axis
    }
}

/// Turns a unit vector; components that are rounding of the turn are zero.
pub(crate) fn turned_direction(rotation: DQuat, direction: DVec3) -> DVec3 {
    if rotation == DQuat::IDENTITY { direction } else { without_rounding(rotation * direction) }
}

/// Turns a vector of any length; components that are rounding of the turn are zero.
pub(crate) fn turned_offset(rotation: DQuat, offset: DVec3) -> DVec3 {
    if rotation == DQuat::IDENTITY {
        return offset;
    }
    let turned = rotation * offset;
    let least = ROUNDING * turned.abs().max_element();
    DVec3::select(turned.abs().cmple(DVec3::splat(least)), DVec3::ZERO, turned)
}

/// Returns the rotation vector of a rotation \[rad\]: its axis times its angle, by the shorter way.
///
/// The angle is `2 atan2(|(x, y, z)|, |w|)`. The quaternion must have length 1; a quaternion and its negative are the same
/// rotation.
pub fn rotation_vector(rotation: DQuat) -> DVec3 {
    let forward = if rotation.w < 0.0 { -rotation } else { rotation };
    let across = DVec3::new(forward.x, forward.y, forward.z);
    let sine = across.dot(across).sqrt();
    if sine == 0.0 {
        return DVec3::ZERO;
    }
    across * (2.0 * libm::atan2(sine, forward.w) / sine)
}
