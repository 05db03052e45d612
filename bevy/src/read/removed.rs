//! Bodies whose entities are gone.

use bevy_ecs::prelude::*;
use carom::Body;

use crate::components::{Ball, Collider, PhysicsBody};
use crate::physics::CaromWorld;

/// Removes the bodies whose entities were despawned, or lost their [`Ball`] or [`Collider`].
pub fn remove_bodies(
    mut commands: Commands,
    mut physics: ResMut<CaromWorld>,
    bodies: Query<(&PhysicsBody, Has<Ball>, Has<Collider>)>,
) {
    let stays = |body: Body, entity: Entity| {
        bodies.get(entity).is_ok_and(|(found, is_ball, is_collider)| {
            let is_there = if matches!(body, Body::Sphere(_)) { is_ball } else { is_collider };
            found.body == body && is_there
        })
    };
    let gone: Vec<_> = physics.bodies().filter(|&(body, entity)| !stays(body, entity)).collect();
    let mut spheres = Vec::new();
    for (body, entity) in gone {
        physics.entities.remove(&body);
        match body {
            // A sphere that a program removed from the world itself is no longer there.
            Body::Sphere(id) if physics.sphere(id).is_ok() => spheres.push(id),
            Body::Sphere(_) => {}
            Body::Collider(id) => drop(physics.remove_collider(id)),
        }
        if bodies.get(entity).is_ok_and(|(found, ..)| found.body == body) {
            commands.entity(entity).remove::<PhysicsBody>();
        }
    }
    if !spheres.is_empty() {
        drop(physics.remove_spheres(&spheres));
    }
}
