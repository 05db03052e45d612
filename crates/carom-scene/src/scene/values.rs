//! Values of fields: vectors, rotations, colours.

use carom::{DQuat, DVec3};

/// Three numbers x, y, z.
pub type Vector = [f64; 3];
/// A rotation as a quaternion x, y, z, w; any length but zero.
pub type Quaternion = [f64; 4];
/// Red, green, blue, each in [0, 1] (sRGB).
pub type Color = [f64; 3];

/// What a field that counts fully is where it is missing.
pub(super) fn one() -> f64 {
    1.0
}

/// The rotation that turns nothing.
pub(super) fn unturned() -> Quaternion {
    [0.0, 0.0, 0.0, 1.0]
}

/// Whether a field may be left out, for it has the value that it has where it is missing.
pub(super) fn is_default<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}

/// The groups that a body is in, if nothing is said.
pub(super) fn first_group() -> u32 {
    1
}

/// Whether a body is in the first group only.
pub(super) fn is_first_group(groups: &u32) -> bool {
    *groups == first_group()
}

/// The groups that a body collides with, if nothing is said.
pub(super) fn all_groups() -> u32 {
    u32::MAX
}

/// Whether a body collides with all groups.
pub(super) fn are_all_groups(groups: &u32) -> bool {
    *groups == all_groups()
}

/// Whether a rotation turns nothing.
pub(super) fn is_unturned(value: &Quaternion) -> bool {
    *value == unturned()
}

/// A vector, to compute with.
pub(crate) fn vector(value: Vector) -> DVec3 {
    DVec3::from_array(value)
}

/// A rotation, to compute with; of any length.
pub(crate) fn quaternion(value: Quaternion) -> DQuat {
    DQuat::from_array(value)
}
