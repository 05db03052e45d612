use glam::DVec3;

use super::{Force, ForceDerivatives, LinearForce, SphereState};
use crate::error::InvalidValue;
use crate::validate;

/// The same force on every sphere, whatever its mass: `F = force`.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ConstantForce {
    /// Force \[N\].
    pub force: DVec3,
}

impl ConstantForce {
    /// A constant force \[N\].
    pub fn new(force: DVec3) -> Self {
        Self { force }
    }
}

impl Force for ConstantForce {
    fn on(&self, _sphere: &SphereState, _time: f64) -> DVec3 {
        self.force
    }

    /// `-F · x`, zero at the origin.
    fn potential_energy(&self, sphere: &SphereState, _time: f64) -> f64 {
        -self.force.dot(sphere.position)
    }

    fn linear(&self, _radius: f64, mass: f64) -> Option<LinearForce> {
        Some(LinearForce { acceleration: self.force / mass, drag_rate: 0.0 })
    }

    fn is_conservative(&self) -> bool {
        true
    }

    fn derivatives(&self, _sphere: &SphereState, _time: f64) -> Option<ForceDerivatives> {
        Some(ForceDerivatives::ZERO)
    }

    fn validate(&self) -> Result<(), InvalidValue> {
        validate::finite("force", self.force)
    }
}
