//! Gravity.

use bevy_ecs::message::MessageWriter;
use bevy_ecs::prelude::*;

use crate::components::Gravity;
use crate::convert::to_carom;
use crate::messages::{PhysicsError, logged};
use crate::physics::CaromWorld;

/// Sets the force of gravity to that of the resource, where the two differ.
pub fn read_gravity(
    mut physics: ResMut<CaromWorld>,
    gravity: Option<Res<Gravity>>,
    mut errors: MessageWriter<PhysicsError>,
) {
    let wanted = gravity.map(|it| it.0);
    if wanted == physics.gravity.map(|(_, acceleration)| acceleration) {
        return;
    }
    if let Some((id, _)) = physics.gravity.take() {
        // It is gone already where a program removed it.
        drop(physics.remove_force(id));
    }
    let Some(acceleration) = wanted else { return };
    match physics.add_force(carom::Gravity::new(to_carom(acceleration))) {
        Ok(id) => physics.gravity = Some((id, acceleration)),
        Err(error) => drop(errors.write(logged(None, error))),
    }
}
