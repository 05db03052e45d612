//! Requirements on single values of a scene.

use crate::error::Problem;
use crate::scene::values::{Quaternion, Vector, quaternion, vector};

pub(crate) fn check(
    holds: bool,
    path: &str,
    problem: impl FnOnce() -> String,
) -> Result<(), Problem> {
    if holds { Ok(()) } else { Err(Problem::new(path, problem())) }
}

pub(crate) fn check_positive(value: f64, path: &str) -> Result<(), Problem> {
    check(value > 0.0 && value.is_finite(), path, || {
        format!("must be positive and finite, not {value}")
    })
}

pub(crate) fn check_non_negative(value: f64, path: &str) -> Result<(), Problem> {
    check(value >= 0.0 && value.is_finite(), path, || {
        format!("must be zero or positive, and finite, not {value}")
    })
}

pub(crate) fn check_vector(value: Vector, path: &str) -> Result<(), Problem> {
    check(vector(value).is_finite(), path, || format!("must be finite, not {value:?}"))
}

pub(crate) fn check_direction(value: Vector, path: &str) -> Result<(), Problem> {
    let length_squared = vector(value).length_squared();
    check(length_squared.is_finite() && length_squared >= f64::MIN_POSITIVE, path, || {
        format!("must be a direction that is finite and not zero, not {value:?}")
    })
}

pub(crate) fn check_rotation(value: Quaternion, path: &str) -> Result<(), Problem> {
    let length_squared = quaternion(value).length_squared();
    check(length_squared.is_finite() && length_squared >= f64::MIN_POSITIVE, path, || {
        format!("must be a quaternion x, y, z, w that is finite and not zero, not {value:?}")
    })
}

/// Refuses a sphere whose kinetic energy is not finite; `field` has its speed. A sphere that is itself not finite is
/// left to the world, which names the field.
pub(crate) fn check_energy(sphere: &carom::Sphere, field: &str) -> Result<(), Problem> {
    let energy = sphere.kilograms() * sphere.velocity.length_squared();
    let is_number = sphere.velocity.is_finite() && sphere.kilograms().is_finite();
    check(energy.is_finite() || !is_number, field, || {
        "is too large: the kinetic energy would be infinite".into()
    })
}
