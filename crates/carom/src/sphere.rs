//! One sphere, and its mass.

use std::f64::consts::PI;

use glam::{DQuat, DVec3};

use crate::error::InvalidValue;
use crate::forces::SphereState;
use crate::friction::Friction;
use crate::groups::Groups;
use crate::id::SphereId;
use crate::restitution::RestitutionLaw;
use crate::validate;

/// Moment of inertia of a solid ball, divided by m r².
pub const SOLID_BALL: f64 = 2.0 / 5.0;
/// Moment of inertia of a thin spherical shell, divided by m r².
pub const THIN_SHELL: f64 = 2.0 / 3.0;

/// Mass, or the density to compute it from.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Mass {
    /// Mass \[kg\], > 0.
    Kilograms(f64),
    /// Density \[kg/m³\], > 0; the mass is density times the sphere's volume.
    Density(f64),
}

impl From<f64> for Mass {
    /// This many kilograms.
    fn from(kilograms: f64) -> Self {
        Self::Kilograms(kilograms)
    }
}

/// One sphere, as it is added to a world and read from it.
///
/// ```
/// use carom::{DVec3, Sphere};
///
/// let sphere = Sphere::new(DVec3::new(0.0, 2.0, 0.0), 0.5)
///     .with_velocity(DVec3::X)
///     .with_density(1000.0)
///     .with_restitution(0.8);
/// assert_eq!(sphere.kilograms(), 1000.0 * carom::volume(0.5));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Sphere {
    /// Centre \[m\].
    pub position: DVec3,
    /// Velocity \[m/s\].
    pub velocity: DVec3,
    /// Radius \[m\], > 0.
    pub radius: f64,
    /// Mass or density; a world returns [`Mass::Kilograms`].
    pub mass: Mass,
    /// Coefficient of restitution in \[0, 1\].
    pub restitution: f64,
    /// Law of restitution, instead of `restitution`: `None` unless given.
    pub restitution_law: Option<RestitutionLaw>,
    /// Friction at its surface; `None` in each coefficient unless given.
    pub friction: Friction,
    /// Rotation from its own coordinate system to the world's; any length but zero.
    pub orientation: DQuat,
    /// Angular velocity, along the axis of rotation \[rad/s\].
    pub angular_velocity: DVec3,
    /// Moment of inertia about any axis through the centre, divided by m r², > 0: [`SOLID_BALL`]
    /// unless given, [`THIN_SHELL`] for a hollow one.
    pub inertia_factor: f64,
    /// Which bodies it collides with.
    pub groups: Groups,
    /// Speed at which its radius grows \[m/s\], >= 0, while its mass stays: 0 unless given. Under the rule `exact`
    /// alone, among elastic spheres without forces: `docs/physics/growth.md`.
    pub growth_speed: f64,
    /// Number of its material for [`World::set_material_pairs`](crate::World::set_material_pairs); 0, for none, unless
    /// given.
    pub material: u8,
    /// Number of the program's own; no part of the physics.
    pub user_data: u64,
}

impl Sphere {
    /// A solid ball at rest, of 1 kg, that leaves restitution (its own is 1) and friction to what it
    /// meets.
    pub fn new(position: DVec3, radius: f64) -> Self {
        Self {
            position,
            velocity: DVec3::ZERO,
            radius,
            mass: Mass::Kilograms(1.0),
            restitution: 1.0,
            restitution_law: None,
            friction: Friction::default(),
            orientation: DQuat::IDENTITY,
            angular_velocity: DVec3::ZERO,
            inertia_factor: SOLID_BALL,
            groups: Groups::DEFAULT,
            growth_speed: 0.0,
            material: 0,
            user_data: 0,
        }
    }

    /// Returns the sphere with its centre at this place \[m\].
    pub fn with_position(self, position: DVec3) -> Self {
        Self { position, ..self }
    }

    /// Returns the sphere with this radius \[m\].
    pub fn with_radius(self, radius: f64) -> Self {
        Self { radius, ..self }
    }

    /// Returns the sphere with this velocity \[m/s\].
    pub fn with_velocity(self, velocity: DVec3) -> Self {
        Self { velocity, ..self }
    }

    /// Returns the sphere with this mass: a number \[kg\], or a [`Mass`].
    pub fn with_mass(self, mass: impl Into<Mass>) -> Self {
        Self { mass: mass.into(), ..self }
    }

    /// Returns the sphere with the mass of this density \[kg/m³\].
    pub fn with_density(self, density: f64) -> Self {
        Self { mass: Mass::Density(density), ..self }
    }

    /// Returns the sphere with this coefficient of restitution, without a law.
    pub fn with_restitution(self, restitution: f64) -> Self {
        Self { restitution, restitution_law: None, ..self }
    }

    /// Returns the sphere with this law of restitution.
    pub fn with_restitution_law(self, law: RestitutionLaw) -> Self {
        Self { restitution_law: Some(law), ..self }
    }

    /// Returns the sphere of this material.
    pub fn with_material(self, material: u8) -> Self {
        Self { material, ..self }
    }

    /// Returns the sphere with this friction: a coefficient, or a [`Friction`].
    pub fn with_friction(self, friction: impl Into<Friction>) -> Self {
        Self { friction: friction.into(), ..self }
    }

    /// Returns the sphere with this orientation.
    pub fn with_orientation(self, orientation: DQuat) -> Self {
        Self { orientation, ..self }
    }

    /// Returns the sphere with this angular velocity \[rad/s\].
    pub fn with_angular_velocity(self, angular_velocity: DVec3) -> Self {
        Self { angular_velocity, ..self }
    }

    /// Returns the sphere with this moment of inertia, divided by m r².
    pub fn with_inertia_factor(self, inertia_factor: f64) -> Self {
        Self { inertia_factor, ..self }
    }

    /// Returns the sphere in these groups.
    pub fn with_groups(self, groups: Groups) -> Self {
        Self { groups, ..self }
    }

    /// Returns the sphere with a radius that grows at this speed \[m/s\].
    pub fn with_growth_speed(self, growth_speed: f64) -> Self {
        Self { growth_speed, ..self }
    }

    /// Returns the sphere with this number of the program's own.
    pub fn with_user_data(self, user_data: u64) -> Self {
        Self { user_data, ..self }
    }

    /// Mass \[kg\], however it was given.
    pub fn kilograms(&self) -> f64 {
        match self.mass {
            Mass::Kilograms(kilograms) => kilograms,
            Mass::Density(density) => density * volume(self.radius),
        }
    }

    /// The state on which forces depend.
    pub(crate) fn state(&self) -> SphereState {
        SphereState {
            position: self.position,
            velocity: self.velocity,
            radius: self.radius,
            mass: self.kilograms(),
        }
    }

    /// Whether it is turned, or turns.
    pub(crate) fn is_turned(&self) -> bool {
        self.orientation != DQuat::IDENTITY || self.angular_velocity != DVec3::ZERO
    }

    pub(crate) fn validate(&self) -> Result<(), InvalidValue> {
        validate::finite("position", self.position)?;
        validate::finite("velocity", self.velocity)?;
        validate::positive("radius", self.radius)?;
        match self.mass {
            Mass::Kilograms(mass) => validate::positive("mass", mass)?,
            // So small or large a sphere that its mass is no number is refused here, too.
            Mass::Density(density) => {
                validate::positive("density", density)?;
                validate::positive("density times volume", self.kilograms())?;
            }
        }
        validate::unit_interval("restitution", self.restitution)?;
        self.restitution_law.map_or(Ok(()), |law| law.validate())?;
        self.friction.validate()?;
        validate::rotation("orientation", self.orientation)?;
        validate::finite("angular_velocity", self.angular_velocity)?;
        validate::positive("inertia_factor", self.inertia_factor)?;
        validate::non_negative("growth_speed", self.growth_speed)
    }
}

/// Volume of a sphere \[m³\], 4/3 π r³.
pub fn volume(radius: f64) -> f64 {
    4.0 / 3.0 * PI * (radius * radius * radius)
}

/// Position and velocity of a sphere, for [`World::set_motions`](crate::World::set_motions).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SphereMotion {
    /// The sphere.
    pub id: SphereId,
    /// Centre \[m\].
    pub position: DVec3,
    /// Velocity \[m/s\].
    pub velocity: DVec3,
}
