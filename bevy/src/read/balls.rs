//! Balls that programs added or changed.

use bevy_ecs::message::MessageWriter;
use bevy_ecs::prelude::*;
use bevy_ecs::query::QueryData;
use bevy_transform::components::Transform;
use carom::{Body, Sphere};

use super::places::Places;
use crate::components::{AngularVelocity, Ball, LinearVelocity, PhysicsBody};
use crate::convert::{pose_of, to_carom};
use crate::messages::{PhysicsError, logged};
use crate::physics::CaromWorld;

/// What describes a ball.
#[derive(QueryData)]
pub struct BallParts {
    entity: Entity,
    ball: Ref<'static, Ball>,
    transform: Ref<'static, Transform>,
    linear: Ref<'static, LinearVelocity>,
    angular: Ref<'static, AngularVelocity>,
}

impl BallPartsItem<'_, '_> {
    fn is_changed(&self) -> bool {
        self.ball.is_changed()
            || self.transform.is_changed()
            || self.linear.is_changed()
            || self.angular.is_changed()
    }

    /// Returns the properties of the ball with the motion of `motion`, and the velocities of its components.
    fn sphere_with(&self, properties: &Sphere, motion: &Sphere) -> Sphere {
        properties
            .with_position(motion.position)
            .with_orientation(motion.orientation)
            .with_velocity(to_carom(self.linear.0))
            .with_angular_velocity(to_carom(self.angular.0))
            // As the world returns it, so that the two can be compared.
            .with_mass(properties.kilograms())
    }
}

/// Adds the spheres of new entities, in the order of their indices.
pub fn add_balls(
    mut commands: Commands,
    mut physics: ResMut<CaromWorld>,
    new: Query<BallParts, Without<PhysicsBody>>,
    places: Places,
    mut errors: MessageWriter<PhysicsError>,
) {
    // A refused one is tried again when it is changed.
    let mut new: Vec<_> = new.iter().filter(BallPartsItem::is_changed).collect();
    new.sort_by_key(|parts| parts.entity.index_u32());
    for parts in new {
        let global = places.of(parts.entity, &parts.transform);
        let sphere = parts.sphere_with(&parts.ball.0, &placed(parts.ball.0, &global));
        match physics.add_sphere(sphere) {
            Ok(id) => {
                let body = Body::Sphere(id);
                physics.entities.insert(body, parts.entity);
                let body = PhysicsBody { body, local: *parts.transform, global };
                commands.entity(parts.entity).insert(body);
            }
            Err(error) => drop(errors.write(logged(Some(parts.entity), error))),
        }
    }
}

/// Applies changes of components to the spheres of the world.
pub fn change_balls(
    mut physics: ResMut<CaromWorld>,
    mut balls: Query<(BallParts, &mut PhysicsBody)>,
    places: Places,
    mut errors: MessageWriter<PhysicsError>,
) {
    for (parts, mut body) in &mut balls {
        let Body::Sphere(id) = body.body else { continue };
        let Ok(current) = physics.sphere(id) else { continue };
        let mut motion = current;
        if *parts.transform != body.local {
            let global = places.of(parts.entity, &parts.transform);
            motion = moved(current, &body.global, &global);
            (body.local, body.global) = (*parts.transform, global);
        }
        let properties = if parts.ball.is_changed() { parts.ball.0 } else { current };
        let wanted = parts.sphere_with(&properties, &motion);
        if wanted != current
            && let Err(error) = physics.set_sphere(id, wanted)
        {
            errors.write(logged(Some(parts.entity), error));
        }
    }
}

/// Returns a sphere at a place.
fn placed(sphere: Sphere, place: &Transform) -> Sphere {
    let pose = pose_of(place);
    sphere.with_position(pose.position).with_orientation(pose.rotation)
}

/// Returns a sphere with what changed between two places; the other part keeps all its digits.
fn moved(sphere: Sphere, before: &Transform, now: &Transform) -> Sphere {
    let target = placed(sphere, now);
    let mut moved = sphere;
    if before.translation != now.translation {
        moved.position = target.position;
    }
    if before.rotation != now.rotation {
        moved.orientation = target.orientation;
    }
    moved
}
