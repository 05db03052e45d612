//! Impacts and sensors are reported with their entities, in time and in numbers of closed forms.

mod common;

use bevy_ecs::prelude::*;
use bevy_transform::components::Transform;
use carom_bevy::carom;
use carom_bevy::prelude::*;
use common::{app, messages, steps};

fn ball_at(app: &mut bevy_app::App, x: f32, velocity: f64) -> Entity {
    let velocity = LinearVelocity::new(velocity, 0.0, 0.0);
    app.world_mut().spawn((Ball::new(0.5), velocity, Transform::from_xyz(x, 0.0, 0.0))).id()
}

#[test]
fn an_impact_names_both_balls_and_swaps_their_velocities() {
    let mut app = app();
    let first = ball_at(&mut app, 0.0, 64.0);
    let second = ball_at(&mut app, 1.5, 0.0);
    steps(&mut app, 1);
    let impacts = messages::<Impact>(&app);
    let [impact] = impacts[..] else { panic!("one impact: {impacts:?}") };
    assert_eq!(impact.entities, [first, second]);
    assert_eq!((impact.other(first), impact.other(second)), (Some(second), Some(first)));
    assert_eq!((impact.time, impact.approach_speed, impact.impulse), (0.5 / 64.0, 64.0, 64.0));
    assert_eq!((impact.point.x, impact.normal.x), (1.0, 1.0));
    let velocity = |entity| app.world().get::<LinearVelocity>(entity).map(|it| it.0.x);
    assert_eq!((velocity(first), velocity(second)), (Some(0.0), Some(64.0)));
}

#[test]
fn an_impact_with_a_collider_names_the_collider_first() {
    let mut app = app();
    let place = Transform::from_xyz(2.0, 0.0, 0.0);
    let wall = app.world_mut().spawn((Collider::cuboid(1.0, 9.0, 9.0), place)).id();
    let ball = ball_at(&mut app, 0.0, 96.0);
    steps(&mut app, 1);
    let impacts = messages::<Impact>(&app);
    assert_eq!(impacts.len(), 1);
    assert_eq!(impacts[0].entities, [wall, ball]);
    // 2 m v.
    assert_eq!(impacts[0].impulse, 192.0);
}

#[test]
fn a_fast_ball_enters_and_leaves_a_thin_sensor_within_one_step() {
    let mut app = app();
    let place = Transform::from_xyz(16.0, 0.0, 0.0);
    let gate = app.world_mut().spawn((Collider::cuboid(1.0, 9.0, 9.0).as_sensor(), place)).id();
    let ball = ball_at(&mut app, 0.0, 2048.0);
    steps(&mut app, 1);
    let events = messages::<SensorEvent>(&app);
    let [enters, leaves] = events[..] else { panic!("two events: {events:?}") };
    assert!(enters.enters && !leaves.enters);
    assert_eq!([enters.sensor, enters.ball], [gate, ball]);
    // (16 - 1) m and (16 + 1) m of way, to rounding.
    assert!((enters.time - 15.0 / 2048.0).abs() < 1e-17);
    assert!((leaves.time - 17.0 / 2048.0).abs() < 1e-17);
}

#[test]
fn a_captured_ball_is_named_and_its_entity_despawned() {
    let mut app = app();
    let pocket = Collider::sphere(0.5).with(carom::Collider::capturing);
    let pocket = app.world_mut().spawn((pocket, Transform::from_xyz(2.0, 0.0, 0.0))).id();
    let ball = ball_at(&mut app, 0.0, 96.0);
    steps(&mut app, 1);
    let events = messages::<SensorEvent>(&app);
    assert_eq!((events[0].sensor, events[0].ball), (pocket, ball));
    assert!(app.world().get_entity(ball).is_err());
    assert!(app.world().resource::<CaromWorld>().spheres().is_empty());
}

#[test]
fn a_refused_step_repeats_no_message() {
    let mut app = app();
    ball_at(&mut app, 0.0, 64.0);
    ball_at(&mut app, 1.5, 0.0);
    steps(&mut app, 1);
    app.insert_resource(Gravity(bevy_math::DVec3::splat(f64::MAX)));
    steps(&mut app, 100);
    assert!(app.world().resource::<CaromWorld>().was_refused());
    assert_eq!(messages::<Impact>(&app).len(), 1);
}
