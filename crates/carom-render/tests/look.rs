//! Spheres of a world are drawn plain, or in a pattern that shows how they rotate. These tests make
//! drawings only, no pictures.

use carom::{Collider, Contact, DQuat, DVec3, Gravity, Pose, Settings, Shape, Sphere, World};
use carom_render::{Ball, Drawing, Pattern, draw_world};
use carom_scene::{Palette, Scene};

/// Returns a ball that rolls along x on a plane with this coefficient of friction.
fn rolling(friction: f64) -> World {
    let mut world = World::new(Settings::default().with_rule(Contact::default())).unwrap();
    world.add_force(Gravity::new(DVec3::new(0.0, -9.81, 0.0))).unwrap();
    let plane = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)).with_friction(friction);
    world.add_collider(plane).unwrap();
    world.add_sphere(Sphere::new(DVec3::Y, 1.0).with_velocity(DVec3::X)).unwrap();
    world
}

fn ball(world: &World, rotation: impl Fn(u64) -> Option<DQuat>) -> Ball {
    let scene = Scene::new("");
    let mut drawing = Drawing::default();
    draw_world(&scene, world, &Palette::new(&scene).unwrap(), rotation, &mut drawing);
    assert_eq!(drawing.balls.len(), 1);
    drawing.balls[0]
}

#[test]
fn a_ball_is_banded_from_the_start_where_friction_can_turn_it() {
    let mut world = rolling(0.5);
    let start = ball(&world, |_| None);
    assert_eq!((start.pattern, start.rotation), (Pattern::Banded, DQuat::IDENTITY));
    for _ in 0..30 {
        world.step(1.0 / 60.0).unwrap();
    }
    let turned = ball(&world, |_| None);
    assert_eq!(turned.pattern, Pattern::Banded);
    assert_eq!(turned.rotation, world.spheres().orientations()[0]);
    // Clockwise, seen from +z: it rolls towards +x.
    assert!(turned.rotation.to_scaled_axis().z < -0.2, "{}", turned.rotation);
}

#[test]
fn a_ball_without_spin_is_plain() {
    let mut world = rolling(0.0);
    for _ in 0..2 {
        let ball = ball(&world, |_| None);
        assert_eq!((ball.pattern, ball.rotation), (Pattern::Plain, DQuat::IDENTITY));
        world.step(1.0 / 60.0).unwrap();
    }
}

#[test]
fn a_rotation_from_outside_comes_before_that_of_the_world() {
    let turn = DQuat::from_rotation_x(1.0);
    let ball = ball(&rolling(0.5), |_| Some(turn));
    assert_eq!((ball.pattern, ball.rotation), (Pattern::Striped, turn));
}
