use std::f64::consts::PI;

use glam::{DMat3, DVec3};

use super::derivatives::outer;
use super::{Force, ForceDerivatives, SphereState};
use crate::error::InvalidValue;
use crate::norm::Norm;
use crate::validate;

/// Drag of a medium on a sphere: `F = -1/2 rho c A |w| w`, with the velocity `w = v - u` through the
/// medium and the cross-section `A = pi r²`.
///
/// Without a viscosity the drag coefficient c is constant (Newton's law of drag). With one it depends on
/// the Reynolds number `Re = 2 r rho |w| / eta`, and is
/// `max(24/Re (1 + 0.15 Re^0.687), drag_coefficient)`: for slow spheres Stokes' `F = -6 pi eta r w`, for
/// fast ones the constant. Source: Schiller and Naumann, Zeitschrift des Vereines Deutscher Ingenieure
/// 77, 318 (1933), good to a few parts in a hundred for Re < 800.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct QuadraticDrag {
    /// Density rho of the medium \[kg/m³\], >= 0.
    pub density: f64,
    /// Drag coefficient of fast spheres, >= 0; 0.44 is Newton's for a smooth sphere.
    pub drag_coefficient: f64,
    /// Dynamic viscosity eta of the medium \[Pa s\], >= 0; 0 for a drag coefficient that is constant.
    pub viscosity: f64,
    /// Velocity u of the medium \[m/s\].
    pub wind: DVec3,
}

impl QuadraticDrag {
    /// Drag of a medium at rest of this density \[kg/m³\], with the constant drag coefficient of a smooth
    /// sphere.
    pub fn new(density: f64) -> Self {
        Self { density, drag_coefficient: 0.44, viscosity: 0.0, wind: DVec3::ZERO }
    }

    /// This drag with another coefficient.
    pub fn with_drag_coefficient(self, drag_coefficient: f64) -> Self {
        Self { drag_coefficient, ..self }
    }

    /// This drag in a medium with a dynamic viscosity \[Pa s\], so that the coefficient depends on the Reynolds number.
    pub fn with_viscosity(self, viscosity: f64) -> Self {
        Self { viscosity, ..self }
    }

    /// This drag in a medium that moves with a velocity \[m/s\].
    pub fn with_wind(self, wind: DVec3) -> Self {
        Self { wind, ..self }
    }

    /// `1/2 rho c A |w|` \[kg/s\] for a sphere of this radius \[m\] at this speed \[m/s\].
    fn rate(&self, radius: f64, speed: f64) -> f64 {
        let of = |coefficient: f64| 0.5 * self.density * coefficient * PI * radius * radius * speed;
        let newton = of(self.drag_coefficient);
        let reynolds = 2.0 * radius * self.density * speed / self.viscosity;
        if self.viscosity == 0.0 || !reynolds.is_finite() {
            return newton;
        }
        // Stokes' law written out, as its coefficient grows without bound where the speed goes to 0.
        let stokes = 6.0 * PI * self.viscosity * radius;
        newton.max(stokes * (1.0 + 0.15 * libm::pow(reynolds, 0.687)))
    }

    /// Returns [`Self::rate`] and its derivatives by the radius and by the speed.
    fn rate_and_slopes(&self, radius: f64, speed: f64) -> [f64; 3] {
        let rate = self.rate(radius, speed);
        let newton = 0.5 * self.density * self.drag_coefficient * PI * radius * radius;
        if rate == newton * speed || speed == 0.0 {
            return [rate, 2.0 * rate / radius, newton];
        }
        // What the Reynolds number adds grows with its power.
        let stokes = 6.0 * PI * self.viscosity * radius;
        let faster = 0.687 * (rate - stokes);
        [rate, (rate + faster) / radius, faster / speed]
    }
}

impl Force for QuadraticDrag {
    fn on(&self, sphere: &SphereState, _time: f64) -> DVec3 {
        let relative = sphere.velocity - self.wind;
        -self.rate(sphere.radius, relative.norm()) * relative
    }

    fn derivatives(&self, sphere: &SphereState, _time: f64) -> Option<ForceDerivatives> {
        let relative = sphere.velocity - self.wind;
        let (radius, speed) = (sphere.radius, relative.norm());
        let [rate, by_radius, by_speed] = self.rate_and_slopes(radius, speed);
        let along = if speed > 0.0 { relative / speed } else { DVec3::ZERO };
        let by_velocity = DMat3::from_diagonal(DVec3::splat(-rate));
        Some(ForceDerivatives {
            by_velocity: by_velocity - outer(by_speed * relative, along),
            by_radius: -by_radius * relative,
            ..ForceDerivatives::ZERO
        })
    }

    fn validate(&self) -> Result<(), InvalidValue> {
        validate::non_negative("density", self.density)?;
        validate::non_negative("drag_coefficient", self.drag_coefficient)?;
        validate::non_negative("viscosity", self.viscosity)?;
        validate::finite("wind", self.wind)
    }
}
