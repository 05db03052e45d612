//! Derivatives of the motion of a sphere.

use glam::DVec3;

use crate::flight::Propagator;

/// Derivative of the motion of a sphere in one direction at one instant, or derivatives of a number with respect to
/// that motion.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct SphereTangent {
    /// Derivative of the centre.
    pub position: DVec3,
    /// Derivative of the velocity.
    pub velocity: DVec3,
    /// Derivative of the angular velocity.
    pub angular_velocity: DVec3,
}

/// Count of numbers in a [`SphereTangent`].
pub(super) const NUMBERS: usize = 9;

impl SphereTangent {
    /// Applies the derivative of a flight during which the acceleration changes by this \[m/s²\].
    pub(super) fn fly(&mut self, over: Propagator, acceleration: DVec3) {
        self.position += over.drift * self.velocity + over.fall * acceleration;
        self.velocity = over.decay * self.velocity + over.drift * acceleration;
    }

    /// Replaces derivatives with respect to the motion at the end of a flight by those with respect to the motion
    /// at its start. Returns the derivative with respect to the acceleration.
    pub(super) fn fly_back(&mut self, over: Propagator) -> DVec3 {
        let by_acceleration = over.fall * self.position + over.drift * self.velocity;
        self.velocity = over.drift * self.position + over.decay * self.velocity;
        by_acceleration
    }

    /// Returns a derivative in which this number is 1 and all others are 0.
    pub(super) fn unit(number: usize) -> Self {
        let axis = DVec3::AXES[number % 3];
        match number / 3 {
            0 => Self { position: axis, ..Self::default() },
            1 => Self { velocity: axis, ..Self::default() },
            _ => Self { angular_velocity: axis, ..Self::default() },
        }
    }

    /// Returns a mutable reference to one of the numbers.
    pub(super) fn number_mut(&mut self, number: usize) -> &mut f64 {
        let vector = match number / 3 {
            0 => &mut self.position,
            1 => &mut self.velocity,
            _ => &mut self.angular_velocity,
        };
        &mut vector[number % 3]
    }

    /// Returns the sum of the products of the numbers.
    pub fn dot(&self, other: &Self) -> f64 {
        self.position.dot(other.position)
            + self.velocity.dot(other.velocity)
            + self.angular_velocity.dot(other.angular_velocity)
    }
}
