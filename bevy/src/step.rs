//! The step of the world.

use bevy_ecs::message::MessageWriter;
use bevy_ecs::prelude::*;
use bevy_time::{Fixed, Time};

use crate::messages::{PhysicsError, logged};
use crate::physics::CaromWorld;

/// Advances the world by one frame. The first of equal refusals in a row is reported.
pub fn advance(
    mut physics: ResMut<CaromWorld>,
    time: Res<Time<Fixed>>,
    mut errors: MessageWriter<PhysicsError>,
) {
    let dt = physics.step_length(time.timestep());
    let CaromWorld { world, frame, refusal, .. } = &mut *physics;
    match world.step(dt) {
        Ok(_) => {
            *frame += 1;
            *refusal = None;
        }
        Err(error) => {
            if refusal.as_ref() != Some(&error) {
                errors.write(logged(None, error.clone()));
            }
            *refusal = Some(error);
        }
    }
}
