//! A scene file as entities has the bits of the scene without Bevy.
#![cfg(feature = "scene")]

mod common;

use bevy_transform::components::Transform;
use carom_bevy::carom_scene::Library;
use carom_bevy::prelude::*;
use common::{app, hash, steps};

#[test]
fn scenes_have_their_bits() {
    for name in ["simtest1", "tutorial4", "billiards"] {
        let (scene, _) = Library::new().find(name, &[]).expect("it is built in");
        let mut app = app();
        app.insert_resource(Gravity::default());
        app.world_mut().load_physics_scene(&scene).expect("it is valid");
        let mut world = scene.world().expect("it is valid");
        assert_eq!(
            app.world().resource::<CaromWorld>().bodies().count(),
            world.spheres().len() + world.colliders().len()
        );
        for _ in 0..30 {
            world.step(scene.simulation.frame_time).expect("a step");
        }
        steps(&mut app, 30);
        assert_eq!(hash(&app), world.state_hash(), "{name}");
        let physics = app.world().resource::<CaromWorld>();
        for (body, entity) in physics.bodies() {
            let place = app.world().get::<Transform>(entity).expect("each body has a place");
            if let carom_bevy::carom::Body::Sphere(id) = body {
                let position = world.sphere(id).expect("the same spheres").position;
                assert_eq!(place.translation.to_array(), position.as_vec3().to_array());
            }
        }
    }
}

#[test]
fn a_second_scene_replaces_the_first() {
    let mut app = app();
    for name in ["simtest1", "simtest1"] {
        let (scene, _) = Library::new().find(name, &[]).expect("it is built in");
        app.world_mut().load_physics_scene(&scene).expect("it is valid");
        steps(&mut app, 2);
    }
    let mut balls = app.world_mut().query::<&Ball>();
    assert_eq!(balls.iter(app.world()).count(), 1);
}
