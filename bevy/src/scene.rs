//! Scene files as entities.

use std::time::Duration;

use bevy_ecs::world::World;
use bevy_time::{Fixed, Time};
use carom_scene::{Scene, SceneError};

use crate::components::Gravity;
use crate::physics::CaromWorld;
use crate::write;

/// Replaces the physics by that of a scene.
pub fn load(world: &mut World, scene: &Scene) -> Result<(), SceneError> {
    let frame_time = scene.simulation.frame_time;
    let physics =
        CaromWorld { world: scene.world()?, frame_time: Some(frame_time), ..CaromWorld::default() };
    let before = std::mem::replace(&mut *world.resource_mut::<CaromWorld>(), physics);
    for entity in before.entities.into_values() {
        world.try_despawn(entity).ok();
    }
    world.remove_resource::<Gravity>();
    world.resource_mut::<Time<Fixed>>().set_timestep(Duration::from_secs_f64(frame_time));
    // The system has no condition that could keep it from running.
    world.run_system_cached(write::adopt_bodies).ok();
    Ok(())
}
