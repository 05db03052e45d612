//! Impulse of a cue's tip on a sphere.

use glam::DVec3;

use crate::error::InvalidValue;
use crate::sphere::Sphere;
use crate::validate;

/// Mass of a cue unless given \[kg\]: 20 ounces.
const CUE_MASS: f64 = 0.567;

/// A cue that strikes a sphere.
///
/// The tip meets the sphere at one instant and one point without slip, and no energy is lost (Leckie and Greenspan,
/// "Pool physics simulation by event prediction", ICGA J. 29 (2006); Alciatore, TP A.30). With the direction d of the
/// cue, the point r of the tip from the centre, u the velocity of the sphere there, its mass m and moment of inertia I,
/// and M the mass of the cue, the impulse is
///
/// ```text
/// J = 2 (V - u·d) / (1/m + 1/M + |r × d|²/I) d
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Strike {
    /// Direction in which the tip moves, of any length but zero.
    pub direction: DVec3,
    /// Vector from the centre of the sphere to the axis of the cue \[m\]; its part along the direction does not count.
    pub offset: DVec3,
    /// Speed of the tip V \[m/s\], >= 0.
    pub speed: f64,
    /// Mass of the cue \[kg\], > 0.
    pub cue_mass: f64,
}

impl Strike {
    /// Creates a strike at the middle of a sphere with a cue of 0.567 kg.
    pub fn new(direction: DVec3, speed: f64) -> Self {
        Self { direction, offset: DVec3::ZERO, speed, cue_mass: CUE_MASS }
    }

    /// Returns the strike with the axis of the cue off the centre of the sphere \[m\].
    pub fn with_offset(self, offset: DVec3) -> Self {
        Self { offset, ..self }
    }

    /// Returns the strike with a cue of this mass \[kg\].
    pub fn with_cue_mass(self, cue_mass: f64) -> Self {
        Self { cue_mass, ..self }
    }

    /// Returns the impulse \[N s\] on a sphere, zero if that moves ahead of the tip, and the point of the tip from its
    /// centre \[m\].
    ///
    /// # Errors
    /// For an invalid number, or an axis that passes beside the sphere.
    pub(crate) fn impulse_on(&self, sphere: &Sphere) -> Result<(DVec3, DVec3), InvalidValue> {
        validate::direction("direction", self.direction)?;
        validate::finite("offset", self.offset)?;
        validate::non_negative("speed", self.speed)?;
        validate::positive("cue_mass", self.cue_mass)?;
        let direction = self.direction.normalize();
        let across = self.offset - self.offset.dot(direction) * direction;
        let (radius, mass) = (sphere.radius, sphere.kilograms());
        let depth_squared = radius * radius - across.dot(across);
        let requirement = "less than the radius of the sphere in size";
        validate::require(depth_squared > 0.0, "offset", requirement, self.offset)?;
        let point = across - depth_squared.sqrt() * direction;
        let inertia = sphere.inertia_factor * mass * radius * radius;
        let surface = sphere.velocity + sphere.angular_velocity.cross(point);
        let closing = (self.speed - surface.dot(direction)).max(0.0);
        let give = mass.recip() + self.cue_mass.recip() + across.dot(across) / inertia;
        Ok((2.0 * closing / give * direction, point))
    }
}
