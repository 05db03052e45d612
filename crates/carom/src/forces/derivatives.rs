//! Derivatives of forces by the states of spheres.

use glam::{DMat3, DVec3};

/// Derivatives of the force on a sphere by the state of a sphere: that one, or another one.
///
/// [`Tangents`](crate::Tangents) and [`Tape`](crate::Tape) need them where forces have no closed form.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ForceDerivatives {
    /// Derivative by the centre \[N/m\]: column k by its coordinate k.
    pub by_position: DMat3,
    /// Derivative by the velocity \[N s/m\]: column k by its component k.
    pub by_velocity: DMat3,
    /// Derivative by the radius at constant mass \[N/m\].
    pub by_radius: DVec3,
    /// Derivative by the mass at constant radius \[N/kg\].
    pub by_mass: DVec3,
}

impl ForceDerivatives {
    /// Derivatives of a force that does not depend on the sphere.
    pub const ZERO: Self = Self {
        by_position: DMat3::ZERO,
        by_velocity: DMat3::ZERO,
        by_radius: DVec3::ZERO,
        by_mass: DVec3::ZERO,
    };
}

/// Returns the matrix of `x -> a (b · x)`.
pub(super) fn outer(a: DVec3, b: DVec3) -> DMat3 {
    DMat3::from_cols(b.x * a, b.y * a, b.z * a)
}

/// Returns the matrix of `x -> a × x`.
pub(super) fn cross(a: DVec3) -> DMat3 {
    DMat3::from_cols(a.cross(DVec3::X), a.cross(DVec3::Y), a.cross(DVec3::Z))
}
