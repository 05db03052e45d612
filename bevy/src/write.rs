//! Writes the state of the world to the components of its bodies.

use std::collections::BTreeMap;

use bevy_ecs::prelude::*;
use bevy_ecs::query::QueryData;
use bevy_math::Vec3;
use bevy_transform::components::{GlobalTransform, Transform};
use bevy_transform::helper::TransformHelper;
use carom::{Body, Pose};

use crate::components::{AngularVelocity, Ball, Collider, Kinematic, LinearVelocity, PhysicsBody};
use crate::convert::{place_of, to_bevy};
use crate::physics::CaromWorld;
use crate::read::colliders::is_moving;

/// Spawns entities for bodies that have none: spheres of emitters, and what programs added to the world itself.
pub fn adopt_bodies(mut commands: Commands, mut physics: ResMut<CaromWorld>) {
    let CaromWorld { world, entities, .. } = &mut *physics;
    for &id in world.spheres().ids() {
        let body = Body::Sphere(id);
        let Ok(sphere) = world.sphere(id) else { continue };
        entities.entry(body).or_insert_with(|| {
            let pose = Pose::at(sphere.position).rotated(sphere.orientation);
            let velocity = LinearVelocity(to_bevy(sphere.velocity));
            let angular_velocity = AngularVelocity(to_bevy(sphere.angular_velocity));
            let motion = (velocity, angular_velocity);
            commands.spawn((Ball(sphere), motion, placed(body, pose))).id()
        });
    }
    for (id, collider) in world.colliders() {
        let body = Body::Collider(id);
        entities.entry(body).or_insert_with(|| {
            commands.spawn((Collider(collider.clone()), placed(body, collider.pose))).id()
        });
    }
}

/// The components of a body at the root of the hierarchy.
fn placed(body: Body, pose: Pose) -> (Transform, PhysicsBody) {
    let place = place_of(pose, Vec3::ONE);
    (place, PhysicsBody { body, local: place, global: place })
}

/// Despawns the entities of spheres that are no longer in the world: captured by sensors, or removed by emitters or
/// programs.
pub fn despawn_bodies(mut commands: Commands, mut physics: ResMut<CaromWorld>) {
    let CaromWorld { world, entities, .. } = &mut *physics;
    entities.retain(|&body, &mut entity| {
        let is_there = match body {
            Body::Sphere(id) => world.sphere(id).is_ok(),
            Body::Collider(id) => world.collider(id).is_ok(),
        };
        if !is_there && let Ok(mut entity) = commands.get_entity(entity) {
            entity.despawn();
        }
        is_there
    });
}

/// The components that a step writes for every body.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct PlaceParts {
    transform: &'static mut Transform,
    body: &'static mut PhysicsBody,
    parent: Option<&'static ChildOf>,
}

impl PlacePartsItem<'_, '_> {
    /// Writes the place of the body. Where nothing moved, nothing counts as changed.
    fn write(&mut self, pose: Pose, parents: &BTreeMap<Entity, GlobalTransform>) {
        let global = place_of(pose, self.transform.scale);
        let parent = self.parent.and_then(|parent| parents.get(&parent.parent()));
        let local = match parent {
            None => global,
            Some(parent) => {
                let scale = self.transform.scale;
                let within = GlobalTransform::from(global).reparented_to(parent);
                Transform { scale, ..within }
            }
        };
        self.transform.set_if_neq(local);
        (self.body.local, self.body.global) = (local, global);
    }
}

/// Places of the parents of bodies, and what a step writes of bodies.
type Parents<'w, 's> =
    (TransformHelper<'w, 's>, Query<'w, 's, &'static ChildOf, With<PhysicsBody>>);

fn places_of((helper, children): &Parents) -> BTreeMap<Entity, GlobalTransform> {
    let place = |parent: Entity| Some((parent, helper.compute_global_transform(parent).ok()?));
    children.iter().filter_map(|child| place(child.parent())).collect()
}

type BallParts<'a> = (PlaceParts, &'a mut Ball, &'a mut LinearVelocity, &'a mut AngularVelocity);

/// Writes places and velocities of balls.
pub fn write_balls(physics: Res<CaromWorld>, mut bodies: ParamSet<(Parents, Query<BallParts>)>) {
    let parents = places_of(&bodies.p0());
    for (mut place, mut ball, mut velocity, mut angular_velocity) in &mut bodies.p1() {
        let Body::Sphere(id) = place.body.body else { continue };
        let Ok(sphere) = physics.sphere(id) else { continue };
        place.write(Pose::at(sphere.position).rotated(sphere.orientation), &parents);
        velocity.set_if_neq(LinearVelocity(to_bevy(sphere.velocity)));
        angular_velocity.set_if_neq(AngularVelocity(to_bevy(sphere.angular_velocity)));
        // Growth is no change of a program.
        ball.bypass_change_detection().0.radius = sphere.radius;
    }
}

type IsDriven = (With<Collider>, Without<Kinematic>);

/// Writes the places of colliders that the world moves.
pub fn write_colliders(
    physics: Res<CaromWorld>,
    mut bodies: ParamSet<(Parents, Query<PlaceParts, IsDriven>)>,
) {
    let parents = places_of(&bodies.p0());
    for mut place in &mut bodies.p1() {
        let Body::Collider(id) = place.body.body else { continue };
        if let Ok(collider) = physics.collider(id)
            && is_moving(&collider)
        {
            place.write(collider.pose, &parents);
        }
    }
}
