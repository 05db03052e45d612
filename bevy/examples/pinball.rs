//! A table of pinball: a tilted box with three bumpers, a paddle that a program moves, a score from impacts and a
//! drain that takes the ball out.
//!
//! `cargo run --release --example pinball` plays twenty seconds without a window and prints what happened.

use bevy_app::{App, FixedUpdate};
use bevy_ecs::prelude::*;
use bevy_math::DVec3;
use bevy_time::{Fixed, Time, TimePlugin, TimeUpdateStrategy};
use bevy_transform::TransformPlugin;
use bevy_transform::components::Transform;
use carom_bevy::carom;
use carom_bevy::prelude::*;

const STEPS_A_SECOND: f64 = 128.0;
const RADIUS: f64 = 0.0135;

#[derive(Component)]
struct Bumper;

#[derive(Component)]
struct Paddle;

#[derive(Resource, Default)]
struct Score {
    points: u32,
    hardest_impulse: f64,
    drained: u32,
}

fn main() {
    let mut app = App::new();
    app.add_plugins((TimePlugin, TransformPlugin, CaromPlugin::default()));
    app.insert_resource(Time::<Fixed>::from_hz(STEPS_A_SECOND));
    let step = std::time::Duration::from_secs_f64(1.0 / STEPS_A_SECOND);
    app.insert_resource(TimeUpdateStrategy::ManualDuration(step));
    // The table lies in the xz plane; z points towards the player, and gravity with it by 6.5 degrees.
    app.insert_resource(Gravity(DVec3::new(0.0, -9.75, 1.11)));
    app.init_resource::<Score>();
    app.add_systems(FixedUpdate, (move_paddle, count_points, serve).chain());
    set_up(&mut app);

    for _ in 0..(20.0 * STEPS_A_SECOND) as u32 {
        app.update();
        let mut balls = app.world_mut().query_filtered::<&Transform, With<Ball>>();
        for place in balls.iter(app.world()) {
            let place = place.translation;
            assert!(place.x.abs() < 0.25 && place.z.abs() < 0.5, "a ball left the table: {place}");
        }
    }
    let score = app.world().resource::<Score>();
    println!("{} points, {} balls drained", score.points, score.drained);
    println!("hardest impact {:.2} N s", score.hardest_impulse);
}

fn set_up(app: &mut App) {
    let hard = |it: carom::Collider| it.with_restitution(0.8);
    let world = app.world_mut();
    world.spawn(
        Collider::new(carom::Shape::Container {
            size: carom::DVec3::new(0.5, 0.06, 1.0),
            open: carom::Sides::NONE,
        })
        .with(hard),
    );
    for (x, z) in [(-0.1, -0.2), (0.1, -0.2), (0.0, -0.33)] {
        let bumper = Collider::cylinder(0.03, 0.06).with(|it| hard(it).with_kick(1.0));
        world.spawn((Bumper, bumper, Transform::from_xyz(x, 0.0, z)));
    }
    let paddle = Collider::cuboid(0.12, 0.06, 0.02).with(hard);
    world.spawn((Paddle, Kinematic, paddle, Transform::from_xyz(0.0, 0.0, 0.38)));
    let drain = Collider::cuboid(0.5, 0.06, 0.02).with(carom::Collider::capturing);
    world.spawn((drain, Transform::from_xyz(0.0, 0.0, 0.49)));
}

/// Follows the ball and strikes when it is near.
fn move_paddle(
    balls: Query<&Transform, (With<Ball>, Without<Paddle>)>,
    mut paddle: Single<&mut Transform, With<Paddle>>,
) {
    let Some(ball) = balls.iter().next() else { return };
    let way = (ball.translation.x - paddle.translation.x).clamp(-0.01, 0.01);
    // Between the paddle and a side wall there is always room for the ball.
    paddle.translation.x = (paddle.translation.x + way).clamp(-0.16, 0.16);
    let is_near = ball.translation.z > 0.3 && ball.translation.z < paddle.translation.z;
    paddle.translation.z = if is_near { (paddle.translation.z - 0.01).max(0.34) } else { 0.38 };
}

fn count_points(
    mut impacts: MessageReader<Impact>,
    mut sensed: MessageReader<SensorEvent>,
    bumpers: Query<(), With<Bumper>>,
    mut score: ResMut<Score>,
) {
    for impact in impacts.read() {
        if bumpers.contains(impact.entities[0]) {
            score.points += 10;
        }
        score.hardest_impulse = score.hardest_impulse.max(impact.impulse);
    }
    score.drained += sensed.read().filter(|event| event.enters).count() as u32;
}

/// Serves a ball where there is none.
fn serve(mut commands: Commands, balls: Query<(), With<Ball>>, score: Res<Score>) {
    if balls.is_empty() {
        let ball = Ball::new(RADIUS).with(|it| it.with_mass(0.08).with_restitution(0.9));
        let velocity = LinearVelocity::new(0.3 + 0.1 * f64::from(score.drained), 0.0, -3.0);
        commands.spawn((ball, velocity, Transform::from_xyz(0.2, -0.0165, 0.3)));
    }
}
