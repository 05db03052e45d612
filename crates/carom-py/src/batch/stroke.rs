//! Changes of the motion of a sphere.

use carom::{DVec3, SphereId, SphereMotion, World};

use crate::failure::Failure;

/// A change of the motion of a sphere by a vector.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stroke {
    /// Sets its position \[m\].
    Position,
    /// Sets its velocity \[m/s\].
    Velocity,
    /// Sets its angular velocity \[rad/s\].
    AngularVelocity,
    /// Applies an impulse \[N s\] at its centre.
    Impulse,
}

impl Stroke {
    const ALL: [Self; 4] = [Self::Position, Self::Velocity, Self::AngularVelocity, Self::Impulse];

    /// Returns the change with the name of its argument.
    ///
    /// # Errors
    /// [`Failure`] if none has it.
    pub fn named(name: &str) -> Result<Self, Failure> {
        let known = Self::ALL.into_iter().find(|it| it.argument() == name);
        known.ok_or_else(|| Failure::unknown("change", name))
    }

    /// Returns the name of its argument in Python.
    pub fn argument(self) -> &'static str {
        match self {
            Self::Position => "position",
            Self::Velocity => "velocity",
            Self::AngularVelocity => "angular_velocity",
            Self::Impulse => "impulse",
        }
    }

    /// Checks the change for a sphere of a world.
    ///
    /// # Errors
    /// [`Failure`] if [`Self::apply`] would refuse it.
    pub fn check(self, world: &World, id: SphereId, value: DVec3) -> Result<(), Failure> {
        let sphere = world.sphere(id)?;
        let after = match self {
            Self::Impulse => sphere.velocity + value / sphere.kilograms(),
            _ => value,
        };
        if after.is_finite() {
            return Ok(());
        }
        Err(Failure::value(self.argument(), format_args!("must be finite, not {value}")))
    }

    /// Applies the change to a sphere of a world.
    ///
    /// # Errors
    /// [`Failure`] if there is no such sphere, or it would no longer be finite.
    pub fn apply(self, world: &mut World, id: SphereId, value: DVec3) -> Result<(), Failure> {
        match self {
            Self::Position => {
                let velocity = world.sphere(id)?.velocity;
                world.set_motions(&[SphereMotion { id, position: value, velocity }])?;
            }
            Self::Velocity => world.set_velocity(id, value)?,
            Self::AngularVelocity => world.set_angular_velocity(id, value)?,
            Self::Impulse => world.apply_impulse(id, value)?,
        }
        Ok(())
    }
}
