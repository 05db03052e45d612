//! Orientations and angular velocities in recordings.

use carom::{DQuat, DVec3, World};

/// Orientation (x, y, z, w) of the sphere at an index.
pub(super) fn orientation(world: &World, index: usize) -> [f64; 4] {
    let orientation = world.spheres().orientations().get(index).copied();
    orientation.unwrap_or(DQuat::IDENTITY).to_array()
}

/// Angular velocity \[rad/s\] of the sphere at an index.
pub(super) fn angular_velocity(world: &World, index: usize) -> [f64; 3] {
    let angular_velocity = world.spheres().angular_velocities().get(index).copied();
    angular_velocity.unwrap_or(DVec3::ZERO).to_array()
}
