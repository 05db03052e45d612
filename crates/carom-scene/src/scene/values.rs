//! Types of values in fields: vectors, rotations, colours.

use carom::{DQuat, DVec3};

/// Three numbers x, y, z.
pub type Vector = [f64; 3];
/// A rotation as a quaternion x, y, z, w; any length but zero.
pub type Quaternion = [f64; 4];
/// Red, green, blue, each in [0, 1] (sRGB).
pub type Color = [f64; 3];

/// Default of fields that are 1 where they are missing.
pub(super) fn one() -> f64 {
    1.0
}

/// Rotation by no angle.
pub(super) fn unturned() -> Quaternion {
    [0.0, 0.0, 0.0, 1.0]
}

/// Whether a value is the default, so that its field need not be written.
pub(super) fn is_default<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}

/// Whether a rotation is the identity as written.
pub(super) fn is_unturned(value: &Quaternion) -> bool {
    *value == unturned()
}

/// Converts a vector to the type of `glam`.
pub(crate) fn vector(value: Vector) -> DVec3 {
    DVec3::from_array(value)
}

/// Converts a rotation to the type of `glam`; its length may differ from 1.
pub(crate) fn quaternion(value: Quaternion) -> DQuat {
    DQuat::from_array(value)
}
