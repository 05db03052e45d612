//! Requirements on single numbers, checked when they are set.

use std::fmt::Display;

use glam::{DQuat, DVec3};

use crate::error::InvalidValue;

type Check = Result<(), InvalidValue>;

/// Any other requirement, in these words.
pub(crate) fn require(
    holds: bool,
    field: &'static str,
    requirement: &'static str,
    value: impl Display,
) -> Check {
    if holds { Ok(()) } else { Err(InvalidValue { field, requirement, value: value.to_string() }) }
}

/// Finite and > 0.
pub(crate) fn positive(field: &'static str, value: f64) -> Check {
    require(value.is_finite() && value > 0.0, field, "positive and finite", value)
}

/// Finite and >= 0.
pub(crate) fn non_negative(field: &'static str, value: f64) -> Check {
    require(value.is_finite() && value >= 0.0, field, "zero or positive, and finite", value)
}

/// Any finite number.
pub(crate) fn finite_number(field: &'static str, value: f64) -> Check {
    require(value.is_finite(), field, "finite", value)
}

/// A coefficient of restitution.
pub(crate) fn unit_interval(field: &'static str, value: f64) -> Check {
    require((0.0..=1.0).contains(&value), field, "in [0, 1]", value)
}

/// A count of at least one.
pub(crate) fn at_least_one(field: &'static str, value: u32) -> Check {
    require(value >= 1, field, "at least 1", value)
}

/// A vector of three finite numbers.
pub(crate) fn finite(field: &'static str, value: DVec3) -> Check {
    require(value.is_finite(), field, "finite", value)
}

/// A vector that has a direction: finite and not zero.
pub(crate) fn direction(field: &'static str, value: DVec3) -> Check {
    let length_squared = value.length_squared();
    // Below this the squares underflow and the direction is lost.
    let normal = length_squared.is_finite() && length_squared >= f64::MIN_POSITIVE;
    require(normal, field, "finite and not zero", value)
}

/// A quaternion that names a rotation: finite and not zero. Its length is set to 1 on use.
pub(crate) fn rotation(field: &'static str, value: DQuat) -> Check {
    let length_squared = value.length_squared();
    // Below this the squares underflow and the direction is lost.
    let normal = length_squared.is_finite() && length_squared >= f64::MIN_POSITIVE;
    require(normal, field, "a quaternion x, y, z, w that is finite and not zero", value)
}
