use glam::{DMat3, DVec3};

use super::{Force, ForceDerivatives, LinearForce, SphereState};
use crate::error::InvalidValue;
use crate::validate;

/// Viscous drag in a wind that is the same everywhere: `F = k (u - v)`.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Wind {
    /// Velocity u of the air \[m/s\].
    pub velocity: DVec3,
    /// Drag coefficient k \[kg/s\], >= 0.
    pub coefficient: f64,
}

impl Wind {
    /// Wind of this velocity \[m/s\], with this coefficient of drag \[kg/s\].
    pub fn new(velocity: DVec3, coefficient: f64) -> Self {
        Self { velocity, coefficient }
    }
}

impl Force for Wind {
    fn on(&self, sphere: &SphereState, _time: f64) -> DVec3 {
        self.coefficient * (self.velocity - sphere.velocity)
    }

    fn linear(&self, _radius: f64, mass: f64) -> Option<LinearForce> {
        let drag_rate = self.coefficient / mass;
        Some(LinearForce { acceleration: drag_rate * self.velocity, drag_rate })
    }

    fn derivatives(&self, _sphere: &SphereState, _time: f64) -> Option<ForceDerivatives> {
        let by_velocity = DMat3::from_diagonal(DVec3::splat(-self.coefficient));
        Some(ForceDerivatives { by_velocity, ..ForceDerivatives::ZERO })
    }

    fn validate(&self) -> Result<(), InvalidValue> {
        validate::finite("velocity", self.velocity)?;
        validate::non_negative("coefficient", self.coefficient)
    }
}
