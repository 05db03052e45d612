use glam::DVec3;

use super::{Force, ForceDerivatives, LinearForce, SphereState};
use crate::error::InvalidValue;
use crate::validate;

/// Uniform gravity, the same acceleration for every sphere: `F = m g`.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Gravity {
    /// Acceleration g \[m/s²\].
    pub acceleration: DVec3,
}

impl Gravity {
    /// Gravity of this acceleration \[m/s²\].
    pub fn new(acceleration: DVec3) -> Self {
        Self { acceleration }
    }
}

impl Force for Gravity {
    fn on(&self, sphere: &SphereState, _time: f64) -> DVec3 {
        sphere.mass * self.acceleration
    }

    /// `-m g · x`, zero at the origin.
    fn potential_energy(&self, sphere: &SphereState, _time: f64) -> f64 {
        -sphere.mass * self.acceleration.dot(sphere.position)
    }

    fn linear(&self, _radius: f64, _mass: f64) -> Option<LinearForce> {
        Some(LinearForce { acceleration: self.acceleration, drag_rate: 0.0 })
    }

    fn is_conservative(&self) -> bool {
        true
    }

    fn derivatives(&self, _sphere: &SphereState, _time: f64) -> Option<ForceDerivatives> {
        Some(ForceDerivatives { by_mass: self.acceleration, ..ForceDerivatives::ZERO })
    }

    fn validate(&self) -> Result<(), InvalidValue> {
        validate::finite("acceleration", self.acceleration)
    }
}
