use glam::{DMat3, DVec3};

use super::derivatives::outer;
use super::{Force, ForceDerivatives, SphereState};
use crate::error::InvalidValue;
use crate::validate;

/// Gravity of a fixed point mass: `F = -m mu r / (r² + e²)^(3/2)`, with r from the point to the centre of the
/// sphere.
///
/// With a softening e the force stays finite at the point: it is that of a Plummer sphere (Plummer,
/// Monthly Notices of the Royal Astronomical Society 71, 460 (1911)). A negative parameter repels.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PointAttractor {
    /// Position of the mass \[m\].
    pub position: DVec3,
    /// Gravitational parameter mu = G M \[m³/s²\].
    pub gravitational_parameter: f64,
    /// Softening length e \[m\], >= 0.
    pub softening: f64,
}

impl PointAttractor {
    /// A point mass of this gravitational parameter \[m³/s²\], without softening.
    pub fn new(position: DVec3, gravitational_parameter: f64) -> Self {
        Self { position, gravitational_parameter, softening: 0.0 }
    }

    /// This attractor with another softening length \[m\].
    pub fn with_softening(self, softening: f64) -> Self {
        Self { softening, ..self }
    }

    /// `r² + e²` \[m²\] of a sphere about `center` \[m\].
    fn softened_square(&self, center: DVec3) -> f64 {
        (center - self.position).length_squared() + self.softening * self.softening
    }
}

impl Force for PointAttractor {
    fn on(&self, sphere: &SphereState, _time: f64) -> DVec3 {
        let square = self.softened_square(sphere.position);
        if square == 0.0 {
            // At the point itself no direction is preferred.
            return DVec3::ZERO;
        }
        let per_mass = self.gravitational_parameter / (square * square.sqrt());
        (sphere.mass * per_mass) * (self.position - sphere.position)
    }

    /// `-m mu / sqrt(r² + e²)`, zero far away.
    fn potential_energy(&self, sphere: &SphereState, _time: f64) -> f64 {
        -sphere.mass * self.gravitational_parameter / self.softened_square(sphere.position).sqrt()
    }

    fn is_conservative(&self) -> bool {
        true
    }

    fn derivatives(&self, sphere: &SphereState, _time: f64) -> Option<ForceDerivatives> {
        let square = self.softened_square(sphere.position);
        if square == 0.0 {
            return None;
        }
        let per_mass = self.gravitational_parameter / (square * square.sqrt());
        let offset = sphere.position - self.position;
        let by_position = outer(3.0 / square * offset, offset) - DMat3::IDENTITY;
        Some(ForceDerivatives {
            by_position: (sphere.mass * per_mass) * by_position,
            by_mass: -per_mass * offset,
            ..ForceDerivatives::ZERO
        })
    }

    fn validate(&self) -> Result<(), InvalidValue> {
        validate::finite("position", self.position)?;
        validate::finite_number("gravitational_parameter", self.gravitational_parameter)?;
        validate::non_negative("softening", self.softening)
    }
}
