use glam::{DMat3, DVec3};

use super::{Force, ForceDerivatives, LinearForce, SphereState};
use crate::error::InvalidValue;
use crate::validate;

/// Viscous drag, against the velocity and proportional to it: `F = -k v`.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ViscousDrag {
    /// Drag coefficient k \[kg/s\], >= 0.
    pub coefficient: f64,
}

impl ViscousDrag {
    /// Drag with this coefficient \[kg/s\].
    pub fn new(coefficient: f64) -> Self {
        Self { coefficient }
    }
}

impl Force for ViscousDrag {
    fn on(&self, sphere: &SphereState, _time: f64) -> DVec3 {
        -self.coefficient * sphere.velocity
    }

    fn linear(&self, _radius: f64, mass: f64) -> Option<LinearForce> {
        Some(LinearForce { acceleration: DVec3::ZERO, drag_rate: self.coefficient / mass })
    }

    fn derivatives(&self, _sphere: &SphereState, _time: f64) -> Option<ForceDerivatives> {
        let by_velocity = DMat3::from_diagonal(DVec3::splat(-self.coefficient));
        Some(ForceDerivatives { by_velocity, ..ForceDerivatives::ZERO })
    }

    fn validate(&self) -> Result<(), InvalidValue> {
        validate::non_negative("coefficient", self.coefficient)
    }
}
