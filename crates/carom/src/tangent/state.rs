//! Derivatives of the motion of a sphere.

use glam::DVec3;

use crate::flight::Propagator;

/// How the motion of a sphere changes in a direction, at one instant; or the derivatives of a number by that
/// motion.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct SphereTangent {
    /// Of its centre.
    pub position: DVec3,
    /// Of its velocity.
    pub velocity: DVec3,
    /// Of its angular velocity.
    pub angular_velocity: DVec3,
}

/// Numbers in a [`SphereTangent`].
pub(super) const NUMBERS: usize = 9;

impl SphereTangent {
    /// Takes it along a flight, while the acceleration changes by this \[m/s²\].
    pub(super) fn fly(&mut self, over: Propagator, acceleration: DVec3) {
        self.position += over.drift * self.velocity + over.fall * acceleration;
        self.velocity = over.decay * self.velocity + over.drift * acceleration;
    }

    /// Takes derivatives by the motion at the end of a flight back to its start. Returns those by the acceleration.
    pub(super) fn fly_back(&mut self, over: Propagator) -> DVec3 {
        let by_acceleration = over.fall * self.position + over.drift * self.velocity;
        self.velocity = over.drift * self.position + over.decay * self.velocity;
        by_acceleration
    }

    /// The one whose numbers are 0 but one, which is 1.
    pub(super) fn unit(number: usize) -> Self {
        let axis = DVec3::AXES[number % 3];
        match number / 3 {
            0 => Self { position: axis, ..Self::default() },
            1 => Self { velocity: axis, ..Self::default() },
            _ => Self { angular_velocity: axis, ..Self::default() },
        }
    }

    /// One of its numbers, to be changed.
    pub(super) fn number_mut(&mut self, number: usize) -> &mut f64 {
        let vector = match number / 3 {
            0 => &mut self.position,
            1 => &mut self.velocity,
            _ => &mut self.angular_velocity,
        };
        &mut vector[number % 3]
    }

    /// Sum of the products of the numbers.
    pub fn dot(&self, other: &Self) -> f64 {
        self.position.dot(other.position)
            + self.velocity.dot(other.velocity)
            + self.angular_velocity.dot(other.angular_velocity)
    }
}
