//! Steps are those of Bevy's fixed schedule, and pictures are drawn between them.

mod common;

use std::time::Duration;

use bevy_app::{FixedUpdate, Update};
use bevy_ecs::prelude::*;
use bevy_math::Vec3;
use bevy_time::TimeUpdateStrategy;
use bevy_transform::components::{GlobalTransform, Transform};
use carom_bevy::prelude::*;
use common::{DT, app, get};

#[derive(Resource, Default)]
struct Seen {
    in_fixed: Vec<f32>,
    in_update: Vec<f32>,
}

#[test]
fn an_interpolated_transform_lies_between_two_steps() {
    let mut app = app();
    app.insert_resource(TimeUpdateStrategy::ManualDuration(Duration::from_secs_f64(DT / 2.0)));
    app.init_resource::<Seen>();
    let see = |mut seen: ResMut<Seen>, ball: Single<&Transform, With<Ball>>| {
        seen.in_update.push(ball.translation.x);
    };
    let see_fixed = |mut seen: ResMut<Seen>, ball: Single<&Transform, With<Ball>>| {
        seen.in_fixed.push(ball.translation.x);
    };
    app.add_systems(Update, see).add_systems(FixedUpdate, see_fixed);
    let velocity = LinearVelocity::new(64.0, 0.0, 0.0);
    app.world_mut().spawn((Ball::new(0.5), velocity, TransformInterpolation::default()));
    // The first update has no time in it.
    for _ in 0..9 {
        app.update();
    }
    let seen = app.world().resource::<Seen>();
    // Two pictures for each step, one step behind.
    assert_eq!(seen.in_update, [0.0, 0.0, 0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0]);
    assert_eq!(seen.in_fixed, [0.0, 1.0, 2.0, 3.0]);
}

#[test]
fn a_place_set_between_steps_is_taken_at_once() {
    let mut app = app();
    app.insert_resource(TimeUpdateStrategy::ManualDuration(Duration::from_secs_f64(DT / 2.0)));
    let velocity = LinearVelocity::new(64.0, 0.0, 0.0);
    let parts = (Ball::new(0.5), velocity, TransformInterpolation::default());
    let ball = app.world_mut().spawn(parts).id();
    for _ in 0..4 {
        app.update();
    }
    app.world_mut().get_mut::<Transform>(ball).unwrap().translation = Vec3::new(0.0, 7.0, 0.0);
    app.update();
    app.update();
    assert_eq!(get::<LinearVelocity>(&app, ball).0.x, 64.0);
    assert_eq!(get::<Transform>(&app, ball).translation.y, 7.0);
}

#[test]
fn an_update_takes_the_steps_of_its_time_and_propagates_places() {
    let mut app = app();
    app.insert_resource(TimeUpdateStrategy::ManualDuration(Duration::from_secs_f64(4.0 * DT)));
    let velocity = LinearVelocity::new(64.0, 0.0, 0.0);
    let ball = app.world_mut().spawn((Ball::new(0.5), velocity)).id();
    app.update();
    app.update();
    assert_eq!(app.world().resource::<CaromWorld>().frame(), 4);
    assert_eq!(get::<GlobalTransform>(&app, ball).translation().x, 4.0);
}

#[test]
fn a_ball_at_rest_counts_as_unchanged() {
    let mut app = app();
    #[derive(Resource, Default)]
    struct Changes(usize);
    app.init_resource::<Changes>();
    let count = |mut changes: ResMut<Changes>,
                 moved: Query<(), (With<Ball>, Changed<Transform>)>| {
        changes.0 += moved.iter().count();
    };
    app.add_systems(Update, count);
    app.world_mut().spawn(Ball::new(0.5));
    for _ in 0..10 {
        app.update();
    }
    assert_eq!(app.world().resource::<Changes>().0, 1, "when it was added");
}
