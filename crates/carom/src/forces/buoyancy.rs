use std::f64::consts::PI;

use glam::DVec3;

use super::derivatives::outer;
use super::{Force, ForceDerivatives, ForceEdge, SphereState};
use crate::error::InvalidValue;
use crate::norm::Norm;
use crate::validate;

/// Buoyancy in a fluid with a level surface: `F = -rho V g`, with the volume V of the sphere that is below
/// the surface (Archimedes).
///
/// The surface is the plane across g at `surface_height` above the origin. A sphere that reaches through it
/// has a cap below, of the height h and the volume `pi h² (3 r - h) / 3`.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Buoyancy {
    /// Density rho of the fluid \[kg/m³\], >= 0.
    pub density: f64,
    /// Height of the surface above the origin, against g \[m\].
    pub surface_height: f64,
    /// Acceleration g of gravity \[m/s²\], not zero. It sets the weight of the fluid and the direction of up. The
    /// weight of spheres comes from a force [`Gravity`](crate::Gravity).
    pub gravity: DVec3,
}

impl Buoyancy {
    /// Buoyancy in a fluid of this density \[kg/m³\] up to this height \[m\], where gravity is -9.81 m/s² along y.
    pub fn new(density: f64, surface_height: f64) -> Self {
        Self { density, surface_height, gravity: DVec3::new(0.0, -9.81, 0.0) }
    }

    /// This buoyancy under another gravity \[m/s²\].
    pub fn with_gravity(self, gravity: DVec3) -> Self {
        Self { gravity, ..self }
    }

    /// Returns how far the lowest point of a sphere is below the surface \[m\]; negative above it.
    fn depth(&self, sphere: &SphereState) -> f64 {
        let height = -sphere.position.dot(self.gravity) / self.gravity.norm();
        self.surface_height - height + sphere.radius
    }
}

impl Force for Buoyancy {
    fn on(&self, sphere: &SphereState, _time: f64) -> DVec3 {
        let (r, h) = (sphere.radius, self.depth(sphere).clamp(0.0, 2.0 * sphere.radius));
        let volume = PI * h * h * (3.0 * r - h) / 3.0;
        -(self.density * volume) * self.gravity
    }

    /// `rho g` times the integral of V over the depth, zero above the surface.
    fn potential_energy(&self, sphere: &SphereState, _time: f64) -> f64 {
        let (r, depth) = (sphere.radius, self.depth(sphere));
        let h = depth.clamp(0.0, 2.0 * r);
        let of_cap = PI * h * h * h * (4.0 * r - h) / 12.0;
        let below = (depth - 2.0 * r).max(0.0) * 4.0 / 3.0 * PI * r * r * r;
        self.density * self.gravity.norm() * (of_cap + below)
    }

    fn is_conservative(&self) -> bool {
        true
    }

    /// Where the lowest and the highest point of the sphere pass the surface.
    fn edges(&self, radius: f64) -> Vec<ForceEdge> {
        let normal = -self.gravity / self.gravity.norm();
        let edge = |reach| ForceEdge { normal, height: self.surface_height + reach };
        vec![edge(-radius), edge(radius)]
    }

    fn derivatives(&self, sphere: &SphereState, _time: f64) -> Option<ForceDerivatives> {
        let (r, h) = (sphere.radius, self.depth(sphere).clamp(0.0, 2.0 * sphere.radius));
        // The area of the cut: the change of the volume with the depth.
        let cut = PI * h * (2.0 * r - h);
        let up = self.gravity / self.gravity.norm();
        Some(ForceDerivatives {
            by_position: outer(-(self.density * cut) * self.gravity, up),
            by_radius: -(self.density * (PI * h * h + cut)) * self.gravity,
            ..ForceDerivatives::ZERO
        })
    }

    fn validate(&self) -> Result<(), InvalidValue> {
        validate::non_negative("density", self.density)?;
        validate::finite_number("surface_height", self.surface_height)?;
        validate::direction("gravity", self.gravity)
    }
}
