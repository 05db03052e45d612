//! The world of the physics as a resource.

use std::collections::BTreeMap;
use std::ops::{Deref, DerefMut};
use std::time::Duration;

use bevy_ecs::prelude::*;
use bevy_math::DVec3;
use carom::{Body, ForceId, World};

/// The [`World`] of the physics, and which entity stands for which of its bodies.
///
/// It dereferences to the [`World`]: energies, persistent contacts, predictions, springs, emitters and forces on all
/// balls are there. A sphere or collider that is added to the world, or emitted, gets an entity in the next step.
#[derive(Resource, Debug, Clone, Default)]
pub struct CaromWorld {
    pub(crate) world: World,
    pub(crate) entities: BTreeMap<Body, Entity>,
    pub(crate) frame: u64,
    /// Length of a frame of the scene \[s\].
    pub(crate) frame_time: Option<f64>,
    /// The force and the acceleration of the resource [`Gravity`](crate::Gravity), as last read.
    pub(crate) gravity: Option<(ForceId, DVec3)>,
    /// Why the last step was refused.
    pub(crate) refusal: Option<carom::Error>,
}

impl CaromWorld {
    /// Returns the number of steps so far.
    pub fn frame(&self) -> u64 {
        self.frame
    }

    /// Returns the entity of a body.
    pub fn entity(&self, body: Body) -> Option<Entity> {
        self.entities.get(&body).copied()
    }

    /// Returns all bodies with their entities, spheres first, in the order of their ids.
    pub fn bodies(&self) -> impl Iterator<Item = (Body, Entity)> {
        self.entities.iter().map(|(&body, &entity)| (body, entity))
    }

    /// Returns the length of a step \[s\] where this is the fixed timestep: that of a scene, if it is the same
    /// rounded to nanoseconds, as a timestep is.
    pub(crate) fn step_length(&self, timestep: Duration) -> f64 {
        let is_timestep = |&seconds: &f64| Duration::from_secs_f64(seconds) == timestep;
        self.frame_time.filter(is_timestep).unwrap_or(timestep.as_secs_f64())
    }

    /// Returns whether the last step was refused; the world is then as it was before that step.
    pub fn was_refused(&self) -> bool {
        self.refusal.is_some()
    }
}

impl Deref for CaromWorld {
    type Target = World;

    fn deref(&self) -> &World {
        &self.world
    }
}

impl DerefMut for CaromWorld {
    fn deref_mut(&mut self) -> &mut World {
        &mut self.world
    }
}
