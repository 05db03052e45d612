//! Poses: place and rotation.

use glam::{DQuat, DVec3};

use crate::error::InvalidValue;
use crate::rotation;
use crate::validate;

/// Place and rotation of a collider: `x_world = position + rotation x_local`.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Pose {
    /// Origin of the local frame \[m\].
    pub position: DVec3,
    /// Rotation from the local frame to the world; any length but zero.
    pub rotation: DQuat,
}

impl Pose {
    /// A pose at a place \[m\], without rotation.
    pub fn at(position: DVec3) -> Self {
        Self { position, rotation: DQuat::IDENTITY }
    }

    /// The pose with this rotation.
    pub fn rotated(self, rotation: DQuat) -> Self {
        Self { rotation, ..self }
    }

    /// The pose after moving on for `h` \[s\].
    pub(crate) fn moved(self, velocity: DVec3, angular_velocity: DVec3, h: f64) -> Self {
        let rotation = rotation::turned(self.rotation, angular_velocity, h);
        Self { position: self.position + h * velocity, rotation }
    }

    pub(crate) fn validate(&self) -> Result<(), InvalidValue> {
        validate::finite("position", self.position)?;
        validate::rotation("rotation", self.rotation)
    }
}
