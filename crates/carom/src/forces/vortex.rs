use std::f64::consts::TAU;

use glam::{DMat3, DVec3};

use super::derivatives::{cross, outer};
use super::{Force, ForceDerivatives, SphereState};
use crate::error::InvalidValue;
use crate::validate;

/// Viscous drag in a vortex about an axis: `F = k (u - v)`, with the air going round the axis at
/// `|u| = C / (2 pi) r / (r² + c²)`, at the distance r from it.
///
/// Within the core radius c the air turns like a solid body, far outside like an ideal vortex of the
/// circulation C. Source: Kaufmann, Ingenieur-Archiv 31, 1 (1962), also named after Scully.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Vortex {
    /// A point of the axis \[m\].
    pub position: DVec3,
    /// Direction of the axis, of any length but zero; the air goes round it counterclockwise as seen
    /// against it, where the circulation is positive.
    pub axis: DVec3,
    /// Circulation C \[m²/s\].
    pub circulation: f64,
    /// Core radius c \[m\], > 0: where the air is fastest.
    pub core_radius: f64,
    /// Drag coefficient k \[kg/s\], >= 0.
    pub coefficient: f64,
}

impl Vortex {
    /// A vortex of this circulation \[m²/s\] about the upward axis through a point, with a core of 1 m and
    /// this coefficient of drag \[kg/s\].
    pub fn new(position: DVec3, circulation: f64, coefficient: f64) -> Self {
        Self { position, axis: DVec3::Y, circulation, core_radius: 1.0, coefficient }
    }

    /// This vortex about an axis in another direction.
    pub fn with_axis(self, axis: DVec3) -> Self {
        Self { axis, ..self }
    }

    /// This vortex with another core radius \[m\].
    pub fn with_core_radius(self, core_radius: f64) -> Self {
        Self { core_radius, ..self }
    }

    /// Velocity of the air at a point \[m/s\].
    pub fn velocity_at(&self, point: DVec3) -> DVec3 {
        let axis = self.axis.normalize();
        let arm = point - self.position;
        let arm = arm - arm.dot(axis) * axis;
        let square = arm.length_squared() + self.core_radius * self.core_radius;
        self.circulation / (TAU * square) * axis.cross(arm)
    }
}

impl Force for Vortex {
    fn on(&self, sphere: &SphereState, _time: f64) -> DVec3 {
        self.coefficient * (self.velocity_at(sphere.position) - sphere.velocity)
    }

    fn derivatives(&self, sphere: &SphereState, _time: f64) -> Option<ForceDerivatives> {
        let axis = self.axis.normalize();
        let arm = sphere.position - self.position;
        let arm = arm - arm.dot(axis) * axis;
        let square = arm.length_squared() + self.core_radius * self.core_radius;
        let rate = self.coefficient * self.circulation / (TAU * square);
        let slower = outer(axis.cross(arm), 2.0 / square * arm);
        Some(ForceDerivatives {
            by_position: rate * (cross(axis) - slower),
            by_velocity: DMat3::from_diagonal(DVec3::splat(-self.coefficient)),
            ..ForceDerivatives::ZERO
        })
    }

    fn validate(&self) -> Result<(), InvalidValue> {
        validate::finite("position", self.position)?;
        validate::direction("axis", self.axis)?;
        validate::finite_number("circulation", self.circulation)?;
        validate::positive("core_radius", self.core_radius)?;
        validate::non_negative("coefficient", self.coefficient)
    }
}
