//! Earlier states of the physics, to continue from.

use std::collections::{BTreeMap, VecDeque};

use bevy_ecs::prelude::*;
use bevy_ecs::world::World;
use bevy_math::DVec3;
use bevy_transform::components::Transform;
use carom::{Body, ForceId, Snapshot};
use thiserror::Error;

use crate::components::{
    AngularVelocity, Ball, Collider, ExternalForce, Gravity, Kinematic, LinearVelocity, PhysicsBody,
};
use crate::interpolation::TransformInterpolation;
use crate::physics::CaromWorld;

/// The physics at one moment: its world, and the entities of its bodies with the components of this crate.
#[derive(Debug, Clone)]
pub struct PhysicsSnapshot {
    world: Snapshot,
    frame: u64,
    gravity: Option<Gravity>,
    applied_gravity: Option<(ForceId, DVec3)>,
    bodies: Vec<SavedBody>,
}

#[derive(Debug, Clone)]
struct SavedBody {
    entity: Entity,
    transform: Transform,
    body: PhysicsBody,
    parts: Parts,
}

#[derive(Debug, Clone)]
enum Parts {
    Ball(Ball, LinearVelocity, AngularVelocity, Option<ExternalForce>),
    Collider(Collider, Option<Kinematic>),
}

impl PhysicsSnapshot {
    /// Returns the number of steps before it.
    pub fn frame(&self) -> u64 {
        self.frame
    }

    /// Saves the physics.
    pub(crate) fn of(world: &World) -> Self {
        let physics = world.resource::<CaromWorld>();
        Self {
            world: physics.snapshot(),
            frame: physics.frame,
            gravity: world.get_resource().copied(),
            applied_gravity: physics.gravity,
            bodies: physics.bodies().filter_map(|(_, it)| SavedBody::of(world, it)).collect(),
        }
    }

    /// Restores the physics: despawns the bodies that were not there, and spawns again those that are gone.
    pub(crate) fn restore(&self, world: &mut World) {
        let saved: BTreeMap<Entity, Body> =
            self.bodies.iter().map(|it| (it.entity, it.body.body)).collect();
        let now = std::mem::take(&mut world.resource_mut::<CaromWorld>().entities);
        for (body, entity) in now {
            if saved.get(&entity) != Some(&body) {
                world.try_despawn(entity).ok();
            }
        }
        let entities = self.bodies.iter().map(|it| (it.body.body, it.restore(world))).collect();
        let mut physics = world.resource_mut::<CaromWorld>();
        physics.world.restore(&self.world);
        physics.entities = entities;
        physics.frame = self.frame;
        physics.gravity = self.applied_gravity;
        physics.refusal = None;
        match self.gravity {
            Some(gravity) => world.insert_resource(gravity),
            None => drop(world.remove_resource::<Gravity>()),
        }
    }
}

impl SavedBody {
    /// Saves a body; `None` if its entity is gone.
    fn of(world: &World, entity: Entity) -> Option<Self> {
        let found = world.get_entity(entity).ok()?;
        let transform = *found.get::<Transform>()?;
        let interpolation = found.get::<TransformInterpolation>();
        let body = *found.get::<PhysicsBody>()?;
        let parts = match body.body {
            Body::Sphere(_) => {
                Parts::Ball(*found.get()?, *found.get()?, *found.get()?, found.get().copied())
            }
            Body::Collider(_) => {
                Parts::Collider(found.get::<Collider>()?.clone(), found.get().copied())
            }
        };
        let transform = interpolation.map_or(transform, |it| it.physical(transform));
        Some(Self { entity, transform, body, parts })
    }

    /// Restores the components of a body. Returns its entity: a new one if its own is gone.
    fn restore(&self, world: &mut World) -> Entity {
        let is_there =
            world.get::<PhysicsBody>(self.entity).is_some_and(|it| it.body == self.body.body);
        let mut entity = if is_there { world.entity_mut(self.entity) } else { world.spawn_empty() };
        let mut place = (self.transform, self.body);
        if !is_there {
            // It has no parent any more.
            place.0 = self.body.global;
            place.1.local = self.body.global;
        }
        entity.insert(place);
        if entity.contains::<TransformInterpolation>() {
            entity.insert(TransformInterpolation::default());
        }
        match &self.parts {
            Parts::Ball(ball, velocity, angular_velocity, force) => {
                entity.insert((*ball, *velocity, *angular_velocity));
                set(&mut entity, *force);
            }
            Parts::Collider(collider, kinematic) => {
                entity.insert(collider.clone());
                set(&mut entity, *kinematic);
            }
        }
        entity.id()
    }
}

/// Inserts a component or removes it.
fn set<C: Component>(entity: &mut EntityWorldMut, component: Option<C>) {
    match component {
        Some(component) => drop(entity.insert(component)),
        None => drop(entity.remove::<C>()),
    }
}

/// Keeps the last states of the physics: one after each step, where an app has this resource.
///
/// [`PhysicsWorldExt::roll_back`](crate::PhysicsWorldExt::roll_back) returns to one of them. With the same input the
/// steps from there give the same bits.
#[derive(Resource, Debug, Clone)]
pub struct Rollback {
    capacity: usize,
    snapshots: VecDeque<PhysicsSnapshot>,
}

/// Why the physics cannot return to a frame.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum RollbackError {
    /// The app has no [`Rollback`].
    #[error("the app has no resource `Rollback`")]
    NotKept,
    /// The frame is not among those that are kept.
    #[error("frame {frame} is not kept; there are {kept}")]
    UnknownFrame {
        /// The frame.
        frame: u64,
        /// Frames that are kept.
        kept: String,
    },
}

impl Rollback {
    /// Keeps this many states.
    pub fn new(capacity: usize) -> Self {
        Self { capacity, snapshots: VecDeque::new() }
    }

    /// Returns the numbers of the frames that are kept, ascending.
    pub fn frames(&self) -> impl DoubleEndedIterator<Item = u64> {
        self.snapshots.iter().map(PhysicsSnapshot::frame)
    }

    /// Returns the state after this many steps.
    pub fn at(&self, frame: u64) -> Option<&PhysicsSnapshot> {
        self.snapshots.iter().find(|it| it.frame == frame)
    }

    /// Adds a state, in place of those of the same frame and later ones.
    fn push(&mut self, snapshot: PhysicsSnapshot) {
        self.snapshots.retain(|it| it.frame < snapshot.frame);
        self.snapshots.push_back(snapshot);
        let surplus = self.snapshots.len().saturating_sub(self.capacity);
        self.snapshots.drain(..surplus);
    }

    fn unknown(&self, frame: u64) -> RollbackError {
        let mut frames = self.frames();
        let kept = match (frames.next(), frames.next_back()) {
            (Some(first), Some(last)) => format!("{first} to {last}"),
            (Some(only), None) => only.to_string(),
            _ => "none".to_owned(),
        };
        RollbackError::UnknownFrame { frame, kept }
    }
}

/// Returns to a frame that is kept.
pub fn roll_back(world: &mut World, frame: u64) -> Result<(), RollbackError> {
    let rollback = world.get_resource::<Rollback>().ok_or(RollbackError::NotKept)?;
    let snapshot = rollback.at(frame).cloned().ok_or_else(|| rollback.unknown(frame))?;
    snapshot.restore(world);
    world.resource_mut::<Rollback>().snapshots.retain(|it| it.frame <= frame);
    Ok(())
}

/// Keeps the state after a step.
pub fn record(world: &mut World) {
    if world.contains_resource::<Rollback>() && !world.resource::<CaromWorld>().was_refused() {
        let snapshot = PhysicsSnapshot::of(world);
        world.resource_mut::<Rollback>().push(snapshot);
    }
}
