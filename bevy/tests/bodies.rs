//! Components and the world of the physics describe the same bodies: what a program changes reaches the world, and the
//! world's state reaches the components, without a bit of the physics lost to `f32`.

mod common;

use bevy_ecs::prelude::*;
use bevy_math::{Quat, Vec3};
use bevy_transform::components::Transform;
use carom_bevy::carom::{self, Body, Error, Pose, Shape, Sphere, World};
use carom_bevy::prelude::*;
use carom_bevy::{PhysicsBody, PhysicsFault};
use common::{DT, RULES, app, app_with, get, hash, messages, settings, steps};

fn sphere_of(app: &bevy_app::App, entity: Entity) -> Sphere {
    let Body::Sphere(id) = get::<PhysicsBody>(app, entity).body() else { panic!("a ball") };
    app.world().resource::<CaromWorld>().sphere(id).expect("it is in the world")
}

#[test]
fn the_state_has_the_bits_of_a_world_without_bevy() {
    for rule in RULES {
        let mut app = app_with(settings(rule()));
        app.insert_resource(Gravity::default());
        let mut world = World::new(settings(rule())).expect("valid settings");
        let gravity = carom::DVec3::new(0.0, -9.81, 0.0);
        world.add_force(carom::Gravity::new(gravity)).expect("finite");
        let (floor, pose) = (Collider::open_box(2.0, 2.0, 2.0), Pose::at(carom::DVec3::ZERO));
        world.add_collider(floor.0.clone().with_pose(pose)).expect("valid");
        app.world_mut().spawn(floor);
        for i in 0..5_u8 {
            let ball = Ball::new(0.125).with(|it| it.with_restitution(0.75).with_friction(0.25));
            let (x, y) = (0.0625 * f32::from(i) - 0.125, 0.3 * f32::from(i) - 0.5);
            let position = Vec3::new(x, y, 0.5 * x);
            let at = carom::DVec3::from_array(position.as_dvec3().to_array());
            world.add_sphere(ball.0.with_position(at)).expect("valid");
            app.world_mut().spawn((ball, Transform::from_translation(position)));
        }
        for _ in 0..128 {
            world.step(DT).expect("a step");
        }
        steps(&mut app, 128);
        assert_eq!(hash(&app), world.state_hash(), "{:?}", rule());
    }
}

#[test]
fn components_are_the_state_of_the_world() {
    let mut app = app();
    let motion = (LinearVelocity::new(0.1, 0.2, 0.3), AngularVelocity::new(1.0, 2.0, 3.0));
    let ball = app.world_mut().spawn((Ball::new(0.5), motion)).id();
    steps(&mut app, 10);
    let sphere = sphere_of(&app, ball);
    let transform: Transform = get(&app, ball);
    assert_eq!(transform.translation.to_array(), sphere.position.as_vec3().to_array());
    assert_eq!(transform.rotation.to_array(), sphere.orientation.as_quat().to_array());
    assert_eq!(get::<LinearVelocity>(&app, ball).0.to_array(), sphere.velocity.to_array());
    // To the rounding of ten additions.
    assert!((sphere.position - carom::DVec3::new(0.1, 0.2, 0.3) * 10.0 * DT).length() < 1e-15);
}

#[test]
fn changed_components_take_effect_in_the_next_step() {
    let mut app = app();
    let ball = app.world_mut().spawn(Ball::new(0.5)).id();
    steps(&mut app, 1);
    app.world_mut().get_mut::<LinearVelocity>(ball).unwrap().0.x = 64.0;
    steps(&mut app, 1);
    assert_eq!(get::<Transform>(&app, ball).translation, Vec3::X);
    app.world_mut().get_mut::<Transform>(ball).unwrap().translation.y = 5.0;
    steps(&mut app, 1);
    assert_eq!(get::<Transform>(&app, ball).translation, Vec3::new(2.0, 5.0, 0.0));
    *app.world_mut().get_mut::<Ball>(ball).unwrap() = Ball::new(0.25).with(|it| it.with_mass(3.0));
    steps(&mut app, 1);
    assert_eq!(sphere_of(&app, ball).radius, 0.25);
    assert_eq!(sphere_of(&app, ball).kilograms(), 3.0);
    assert_eq!(get::<Transform>(&app, ball).translation, Vec3::new(3.0, 5.0, 0.0));
}

#[test]
fn a_turn_by_a_program_leaves_the_digits_of_the_position() {
    let mut app = app();
    let velocity = LinearVelocity::new(0.1, 0.0, 0.0);
    let ball = app.world_mut().spawn((Ball::new(0.5), velocity)).id();
    steps(&mut app, 3);
    let before = sphere_of(&app, ball).position;
    app.world_mut().get_mut::<Transform>(ball).unwrap().rotation = Quat::from_rotation_y(1.0);
    steps(&mut app, 1);
    let expected = before.x + 0.1 * DT;
    // A position rounded to `f32` differs by some 1e-10.
    assert!((sphere_of(&app, ball).position.x - expected).abs() < 1e-16);
    assert!(get::<Transform>(&app, ball).rotation.angle_between(Quat::from_rotation_y(1.0)) < 1e-3);
}

#[test]
fn a_despawned_ball_leaves_the_world() {
    let mut app = app();
    let [first, second] = [0.0, 5.0]
        .map(|x| app.world_mut().spawn((Ball::new(0.5), Transform::from_xyz(x, 0.0, 0.0))).id());
    let wall = app.world_mut().spawn(Collider::half_space()).id();
    steps(&mut app, 1);
    app.world_mut().despawn(first);
    app.world_mut().entity_mut(second).remove::<Ball>();
    app.world_mut().despawn(wall);
    steps(&mut app, 1);
    let physics = app.world().resource::<CaromWorld>();
    assert!(physics.spheres().is_empty());
    assert_eq!(physics.colliders().len(), 0);
    assert_eq!(physics.bodies().count(), 0);
    assert!(app.world().get::<PhysicsBody>(second).is_none());
}

#[test]
fn an_empty_world_steps() {
    for rule in RULES {
        let mut app = app_with(settings(rule()));
        app.insert_resource(Gravity::default());
        steps(&mut app, 3);
        assert_eq!(app.world().resource::<CaromWorld>().frame(), 3);
        assert!(messages::<PhysicsError>(&app).is_empty());
    }
}

#[test]
fn a_fast_ball_does_not_pass_a_thin_wall() {
    let mut app = app();
    let wall = Transform::from_xyz(5.0, 0.0, 0.0);
    app.world_mut().spawn((Collider::cuboid(0.001, 4.0, 4.0), wall));
    let velocity = LinearVelocity::new(10_000.0, 0.0, 0.0);
    let ball = app.world_mut().spawn((Ball::new(0.05), velocity)).id();
    steps(&mut app, 64);
    let sphere = sphere_of(&app, ball);
    assert_eq!(sphere.velocity.x, -10_000.0);
    // There and back: 2 (5 - 0.0005 - 0.05) - v t, to rounding at 10 km.
    assert!((sphere.position.x - (9.899 - 10_000.0)).abs() < 1e-9);
}

#[test]
fn elastic_balls_keep_their_energy() {
    let mut app = app();
    let shape = Shape::Container { size: carom::DVec3::splat(2.0), open: carom::Sides::NONE };
    app.world_mut().spawn(Collider::new(shape));
    for i in 0..27_u8 {
        let [x, y, z] = [i % 3, i / 3 % 3, i / 9].map(|it| 0.5 * f32::from(it) - 0.5);
        let (x64, y64, z64) = (f64::from(x), f64::from(y), f64::from(z));
        let velocity = LinearVelocity::new(1.0 + x64, 2.0 * y64, -z64);
        app.world_mut().spawn((Ball::new(0.125), velocity, Transform::from_xyz(x, y, z)));
    }
    steps(&mut app, 1);
    let before = app.world().resource::<CaromWorld>().kinetic_energy();
    steps(&mut app, 3839);
    let after = app.world().resource::<CaromWorld>().kinetic_energy();
    // A minute, with some thousands of impacts that round to 1e-16 each.
    assert!((after / before - 1.0).abs() < 1e-12, "{}", after / before - 1.0);
}

#[test]
fn a_kinematic_collider_throws_at_twice_its_speed() {
    let mut app = app();
    let collider = (Collider::cuboid(1.0, 1.0, 1.0), Kinematic);
    let paddle = app.world_mut().spawn((collider, Transform::from_xyz(-1.0, 0.0, 0.0))).id();
    let ball = app.world_mut().spawn(Ball::new(0.25)).id();
    steps(&mut app, 1);
    for _ in 0..32 {
        app.world_mut().get_mut::<Transform>(paddle).unwrap().translation.x += 1.0 / 64.0;
        steps(&mut app, 1);
    }
    assert_eq!(sphere_of(&app, ball).velocity.x, 2.0);
    // It stops with its `Transform`.
    steps(&mut app, 10);
    let physics = app.world().resource::<CaromWorld>();
    let (_, paddle) = physics.colliders().next().expect("a collider");
    assert_eq!(paddle.velocity, carom::DVec3::ZERO);
    assert_eq!(paddle.pose.position.x, -0.5);
}

#[test]
fn a_collider_with_a_velocity_moves_its_transform() {
    let mut app = app();
    let moving = |it: carom::Collider| it.moving(carom::DVec3::X, carom::DVec3::ZERO);
    let wall = app.world_mut().spawn(Collider::cuboid(1.0, 1.0, 1.0).with(moving)).id();
    steps(&mut app, 64);
    assert_eq!(get::<Transform>(&app, wall).translation, Vec3::X);
}

#[test]
fn a_changed_collider_keeps_its_place_in_its_motion() {
    let mut app = app();
    let steady = carom::MotionPart::Steady { velocity: carom::DVec3::X };
    let wall = Collider::cuboid(1.0, 1.0, 1.0).with(|it| it.with_motion([steady]));
    let place = Transform::from_xyz(0.0, 2.0, 0.0);
    let wall = app.world_mut().spawn((wall, place)).id();
    steps(&mut app, 32);
    app.world_mut().get_mut::<Collider>(wall).unwrap().0.restitution = 0.25;
    steps(&mut app, 32);
    assert_eq!(get::<Transform>(&app, wall).translation, Vec3::new(1.0, 2.0, 0.0));
    let physics = app.world().resource::<CaromWorld>();
    assert_eq!(physics.colliders().next().map(|(_, it)| it.restitution), Some(0.25));
}

#[test]
fn children_are_placed_by_their_parents() {
    let mut app = app();
    let parent = Transform::from_xyz(1.0, 0.0, 0.0).with_scale(Vec3::splat(2.0));
    let parent = app.world_mut().spawn(parent).id();
    let place = Transform::from_xyz(1.0, 0.0, 0.0);
    let wall = (Collider::cuboid(1.0, 1.0, 1.0), place, ChildOf(parent));
    app.world_mut().spawn(wall);
    let velocity = LinearVelocity::new(0.0, 64.0, 0.0);
    let child = app.world_mut().spawn((Ball::new(0.5), velocity, place, ChildOf(parent))).id();
    steps(&mut app, 1);
    let physics = app.world().resource::<CaromWorld>();
    let (_, wall) = physics.colliders().next().expect("a collider");
    assert_eq!(wall.pose.position, carom::DVec3::new(3.0, 0.0, 0.0));
    assert_eq!(get::<Transform>(&app, child).translation.x, 1.0);
    // It left the wall in which it was, upwards; half of its way in the scaled coordinates of the parent.
    let way = sphere_of(&app, child).position.y;
    assert!((f64::from(get::<Transform>(&app, child).translation.y) - way / 2.0).abs() < 1e-6);
}

#[test]
fn a_force_on_one_ball_accelerates_it_alone() {
    let mut app = app();
    let heavy = Ball::new(0.5).with(|it| it.with_mass(4.0));
    let force = ExternalForce(bevy_math::DVec3::new(8.0, 0.0, 0.0));
    let pushed = app.world_mut().spawn((heavy, force)).id();
    let place = Transform::from_xyz(0.0, 9.0, 0.0);
    let other = app.world_mut().spawn((Ball::new(0.5), place)).id();
    steps(&mut app, 64);
    // v = F t / m, sums of numbers without rounding.
    assert_eq!(sphere_of(&app, pushed).velocity.x, 2.0);
    assert_eq!(sphere_of(&app, other).velocity.x, 0.0);
    app.world_mut().entity_mut(pushed).remove::<ExternalForce>();
    steps(&mut app, 64);
    assert_eq!(sphere_of(&app, pushed).velocity.x, 2.0);
}

#[test]
fn gravity_follows_its_resource() {
    let mut app = app();
    let ball = app.world_mut().spawn(Ball::new(0.5)).id();
    app.insert_resource(Gravity(bevy_math::DVec3::new(0.0, -8.0, 0.0)));
    steps(&mut app, 64);
    assert_eq!(get::<LinearVelocity>(&app, ball).0.y, -8.0);
    app.insert_resource(Gravity(bevy_math::DVec3::new(0.0, 8.0, 0.0)));
    steps(&mut app, 64);
    assert_eq!(get::<LinearVelocity>(&app, ball).0.y, 0.0);
    app.world_mut().remove_resource::<Gravity>();
    steps(&mut app, 64);
    assert_eq!(get::<LinearVelocity>(&app, ball).0.y, 0.0);
    assert_eq!(app.world().resource::<CaromWorld>().forces().len(), 0);
}

#[test]
fn what_is_added_to_the_world_gets_an_entity() {
    let mut app = app();
    let mut physics = app.world_mut().resource_mut::<CaromWorld>();
    let sphere = Sphere::new(carom::DVec3::Y, 0.5);
    let id = physics.add_sphere(sphere).expect("valid");
    let shape = Shape::Sphere { radius: 0.1 };
    let wall = carom::Collider::new(shape, Pose::at(carom::DVec3::NEG_Y));
    physics.add_collider(wall).expect("valid");
    steps(&mut app, 1);
    let physics = app.world().resource::<CaromWorld>();
    assert_eq!(physics.bodies().count(), 2);
    let entity = physics.entity(Body::Sphere(id)).expect("it has one");
    assert_eq!(get::<Transform>(&app, entity).translation, Vec3::Y);
    app.world_mut().resource_mut::<CaromWorld>().remove_sphere(id).expect("it is there");
    steps(&mut app, 1);
    assert!(app.world().get_entity(entity).is_err());
}

#[test]
fn an_invalid_component_is_an_error_and_not_a_body() {
    let mut app = app();
    let ball = app.world_mut().spawn(Ball::new(-1.0)).id();
    steps(&mut app, 2);
    let errors = messages::<PhysicsError>(&app);
    assert_eq!(errors.len(), 1, "reported once: {errors:?}");
    assert_eq!(errors[0].entity, Some(ball));
    assert!(matches!(errors[0].fault, PhysicsFault::World(Error::Invalid { .. })));
    // Mended, it is there.
    app.world_mut().get_mut::<Ball>(ball).unwrap().0.radius = 1.0;
    steps(&mut app, 1);
    assert_eq!(sphere_of(&app, ball).radius, 1.0);
    // A velocity that is no number is refused; the ball keeps its own.
    app.world_mut().get_mut::<LinearVelocity>(ball).unwrap().0.x = f64::NAN;
    steps(&mut app, 1);
    assert_eq!(get::<LinearVelocity>(&app, ball).0.x, 0.0);
    assert_eq!(messages::<PhysicsError>(&app).len(), 2);
}

#[test]
fn a_refused_step_is_an_error_and_leaves_the_state() {
    let mut app = app();
    let velocity = LinearVelocity::new(f64::MAX, 0.0, 0.0);
    let place = Transform::from_xyz(f32::MAX, 0.0, 0.0);
    app.world_mut().spawn((Ball::new(0.5), velocity, place));
    app.insert_resource(Gravity(bevy_math::DVec3::new(f64::MAX, 0.0, 0.0)));
    steps(&mut app, 200);
    let physics = app.world().resource::<CaromWorld>();
    assert!(physics.was_refused());
    assert!(physics.frame() < 200);
    assert_eq!(messages::<PhysicsError>(&app).len(), 1);
}

#[test]
fn a_scaled_app_has_the_same_numbers() {
    let run = |scale: f64| {
        let mut app = app();
        app.insert_resource(Gravity(bevy_math::DVec3::new(0.0, -8.0 * scale, 0.0)));
        app.world_mut().spawn(Collider::half_space());
        let ball = Ball::new(0.25 * scale).with(|it| it.with_restitution(0.5));
        let place = Transform::from_xyz(0.0, 2.0 * scale as f32, 0.0);
        let ball = app.world_mut().spawn((ball, place)).id();
        steps(&mut app, 100);
        sphere_of(&app, ball).position.y / scale
    };
    // Powers of two change no digit.
    assert_eq!(run(1.0), run(2_f64.powi(20)));
    assert_eq!(run(1.0), run(2_f64.powi(-20)));
}
