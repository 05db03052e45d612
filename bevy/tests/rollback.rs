//! A restored physics goes on bit for bit, and entities follow it: those of later bodies are despawned, those of gone
//! bodies are there again.

mod common;

use bevy_app::App;
use bevy_ecs::prelude::*;
use bevy_transform::components::Transform;
use carom_bevy::RollbackError;
use carom_bevy::prelude::*;
use common::{RULES, app, app_with, get, hash, settings, steps};

/// Balls in a box, with a paddle.
fn game(mut app: App) -> (App, Entity) {
    app.insert_resource(Gravity::default());
    app.insert_resource(Rollback::new(32));
    app.world_mut().spawn(Collider::open_box(2.0, 2.0, 2.0));
    for i in 0..6_u8 {
        let ball = Ball::new(0.125).with(|it| it.with_density(2000.0).with_restitution(0.5));
        let place = Transform::from_xyz(0.3 * f32::from(i % 3) - 0.3, 0.3 * f32::from(i / 3), 0.01);
        app.world_mut().spawn((ball, place));
    }
    let paddle = (Collider::cuboid(0.5, 0.125, 0.5), Kinematic);
    let paddle = app.world_mut().spawn((paddle, Transform::from_xyz(0.0, -0.75, 0.0))).id();
    (app, paddle)
}

/// The input of a player, by frame.
fn play(app: &mut App, paddle: Entity, frames: std::ops::Range<u64>) {
    for frame in frames {
        let height = if frame % 16 < 8 { -0.75 } else { -0.5 };
        app.world_mut().get_mut::<Transform>(paddle).unwrap().translation.y = height;
        app.world_mut().step_physics();
    }
}

#[test]
fn a_replay_from_an_earlier_frame_has_the_same_bits() {
    for rule in RULES {
        let (mut app, paddle) = game(app_with(settings(rule())));
        play(&mut app, paddle, 0..50);
        let at_50 = hash(&app);
        play(&mut app, paddle, 50..70);
        let at_70 = hash(&app);
        app.world_mut().roll_back(50).expect("it is kept");
        assert_eq!(hash(&app), at_50);
        assert_eq!(app.world().resource::<CaromWorld>().frame(), 50);
        play(&mut app, paddle, 50..70);
        assert_eq!(hash(&app), at_70, "{:?}", rule());
    }
}

#[test]
fn bodies_of_later_frames_are_despawned_and_gone_ones_are_there_again() {
    let mut app = app();
    app.insert_resource(Rollback::new(8));
    let velocity = LinearVelocity::new(64.0, 0.0, 0.0);
    let gone = app.world_mut().spawn((Ball::new(0.5), velocity)).id();
    steps(&mut app, 2);
    app.world_mut().despawn(gone);
    let place = Transform::from_xyz(0.0, 9.0, 0.0);
    let later = app.world_mut().spawn((Ball::new(0.5), place)).id();
    steps(&mut app, 2);
    app.world_mut().roll_back(2).expect("it is kept");
    assert!(app.world().get_entity(later).is_err());
    let physics = app.world().resource::<CaromWorld>();
    let [(_, again)] = physics.bodies().collect::<Vec<_>>()[..] else { panic!("one body") };
    assert_eq!(get::<Transform>(&app, again).translation.x, 2.0);
    steps(&mut app, 1);
    assert_eq!(get::<Transform>(&app, again).translation.x, 3.0);
    // Once more, where the entity of the snapshot is gone for good.
    app.world_mut().roll_back(1).expect("it is kept");
    assert_eq!(app.world().resource::<CaromWorld>().bodies().count(), 1);
}

#[test]
fn input_that_no_step_has_read_is_restored() {
    let mut app = app();
    let ball = app.world_mut().spawn(Ball::new(0.5)).id();
    steps(&mut app, 1);
    app.world_mut().get_mut::<LinearVelocity>(ball).unwrap().0.x = 64.0;
    let snapshot = app.world().physics_snapshot();
    steps(&mut app, 2);
    app.world_mut().restore_physics(&snapshot);
    steps(&mut app, 1);
    assert_eq!(get::<Transform>(&app, ball).translation.x, 1.0);
}

#[test]
fn gravity_is_restored() {
    let mut app = app();
    app.world_mut().spawn(Ball::new(0.5));
    steps(&mut app, 1);
    let snapshot = app.world().physics_snapshot();
    app.insert_resource(Gravity::default());
    steps(&mut app, 1);
    app.world_mut().restore_physics(&snapshot);
    steps(&mut app, 1);
    assert_eq!(app.world().resource::<CaromWorld>().kinetic_energy(), 0.0);
}

#[test]
fn a_frame_that_is_not_kept_is_an_error() {
    let mut app = app();
    assert_eq!(app.world_mut().roll_back(0), Err(RollbackError::NotKept));
    app.insert_resource(Rollback::new(2));
    steps(&mut app, 4);
    let error = app.world_mut().roll_back(1).expect_err("two are kept");
    assert_eq!(error.to_string(), "frame 1 is not kept; there are 3 to 4");
}
