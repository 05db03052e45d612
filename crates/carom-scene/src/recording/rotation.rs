//! How spheres are turned and turn, in recordings.

use carom::{DQuat, DVec3, Friction, Rule, World};

/// Whether spheres turn in a world, or friction can make them turn: whether recordings of it have
/// orientations and angular velocities. All others stay as short as they are.
pub(super) fn has_rotation(world: &World) -> bool {
    let spheres = world.spheres();
    spheres.orientations().iter().any(|&it| it != DQuat::IDENTITY)
        || spheres.angular_velocities().iter().any(|&it| it != DVec3::ZERO)
        || world.emitters().any(|(_, emitter)| {
            let sphere = &emitter.sphere;
            sphere.orientation != DQuat::IDENTITY || sphere.angular_velocity != DVec3::ZERO
        })
        || has_friction(world)
}

/// Whether friction acts in a world.
fn has_friction(world: &World) -> bool {
    let rubs = |friction: &Friction| friction.sliding.is_some_and(|it| it > 0.0);
    matches!(world.settings().rule, Rule::Contact(_))
        && (world.spheres().frictions().iter().any(rubs)
            || world.colliders().any(|(_, collider)| rubs(&collider.friction))
            || world.emitters().any(|(_, emitter)| rubs(&emitter.sphere.friction)))
}

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
