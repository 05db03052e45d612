//! Colliders that programs added or changed.

use bevy_ecs::message::MessageWriter;
use bevy_ecs::prelude::*;
use bevy_time::{Fixed, Time};
use bevy_transform::components::Transform;
use carom::{Body, ColliderId, Error};

use super::places::Places;
use crate::components::{Ball, Collider, Kinematic, PhysicsBody};
use crate::convert::pose_of;
use crate::messages::{PhysicsError, logged};
use crate::physics::CaromWorld;

type NewCollider<'a> = (Entity, Ref<'a, Collider>, Ref<'a, Transform>);
type IsNew = (Without<PhysicsBody>, Without<Ball>);

/// Adds the colliders of new entities, in the order of their indices.
pub fn add_colliders(
    mut commands: Commands,
    mut physics: ResMut<CaromWorld>,
    new: Query<NewCollider, IsNew>,
    places: Places,
    mut errors: MessageWriter<PhysicsError>,
) {
    // A refused one is tried again when it is changed.
    let mut new: Vec<_> =
        new.iter().filter(|(_, it, place)| it.is_changed() || place.is_changed()).collect();
    new.sort_by_key(|(entity, ..)| entity.index_u32());
    for (entity, collider, transform) in new {
        let global = places.of(entity, &transform);
        match physics.add_collider(collider.0.clone().with_pose(pose_of(&global))) {
            Ok(id) => {
                let body = Body::Collider(id);
                physics.entities.insert(body, entity);
                commands.entity(entity).insert(PhysicsBody { body, local: *transform, global });
            }
            Err(error) => drop(errors.write(logged(Some(entity), error))),
        }
    }
}

type ColliderParts<'a> =
    (Entity, Ref<'a, Collider>, &'a Transform, Has<Kinematic>, &'a mut PhysicsBody);

/// Applies changes of components to the colliders of the world.
pub fn change_colliders(
    mut physics: ResMut<CaromWorld>,
    mut colliders: Query<ColliderParts>,
    places: Places,
    time: Res<Time<Fixed>>,
    mut errors: MessageWriter<PhysicsError>,
) {
    let dt = physics.step_length(time.timestep());
    for (entity, collider, transform, is_kinematic, mut body) in &mut colliders {
        let Body::Collider(id) = body.body else { continue };
        let mut report = |outcome: Result<(), Error>| {
            if let Err(error) = outcome {
                errors.write(logged(Some(entity), error));
            }
        };
        if collider.is_changed() {
            report(change(&mut physics, id, &collider.0));
        }
        let global = places.of(entity, transform);
        let is_driven = physics.collider(id).is_ok_and(|it| !is_kinematic && is_moving(&it));
        let is_moved = if is_driven { *transform != body.local } else { global != body.global };
        if is_moved {
            let pose = pose_of(&global);
            report(if is_kinematic {
                physics.set_next_pose(id, pose, dt)
            } else {
                physics.set_pose(id, pose)
            });
            (body.local, body.global) = (*transform, global);
        } else if is_kinematic {
            report(stop(&mut physics, id));
        }
    }
}

/// Returns whether the world moves a collider.
pub fn is_moving(collider: &carom::Collider) -> bool {
    let zero = carom::DVec3::ZERO;
    !collider.motion.is_empty() || collider.velocity != zero || collider.angular_velocity != zero
}

/// Changes the properties of a collider; its place stays, and so does a motion with the same parts.
fn change(physics: &mut CaromWorld, id: ColliderId, given: &carom::Collider) -> Result<(), Error> {
    let current = physics.collider(id)?;
    let mut wanted = given.clone().with_pose(current.pose);
    if !wanted.motion.is_empty() && wanted.motion.parts() == current.motion.parts() {
        wanted.motion = current.motion.clone();
        wanted.velocity = current.velocity;
        wanted.angular_velocity = current.angular_velocity;
    }
    if wanted == current { Ok(()) } else { physics.set_collider(id, wanted) }
}

/// Stops a collider that has reached its place.
fn stop(physics: &mut CaromWorld, id: ColliderId) -> Result<(), Error> {
    let current = physics.collider(id)?;
    if !is_moving(&current) {
        return Ok(());
    }
    physics.set_collider(id, current.moving(carom::DVec3::ZERO, carom::DVec3::ZERO))
}
