//! `bevy/examples/pinball.rs` under Avian.

use avian3d::prelude::*;
use bevy::prelude::*;
use bevy::time::TimeUpdateStrategy;

const STEPS_A_SECOND: f64 = 128.0;
const RADIUS: f32 = 0.0135;

#[derive(Component)]
struct Ball;

#[derive(Component)]
struct Bumper;

#[derive(Component)]
struct Paddle;

#[derive(Component)]
struct Drain;

#[derive(Resource, Default)]
struct Score {
    points: u32,
    hardest_impulse: f32,
    drained: u32,
    lost: u32,
}

fn main() {
    let mut app = App::new();
    app.add_plugins((
        MinimalPlugins,
        TransformPlugin,
        PhysicsPlugins::default().with_length_unit(0.1),
    ));
    app.insert_resource(Time::<Fixed>::from_hz(STEPS_A_SECOND));
    let step = std::time::Duration::from_secs_f64(1.0 / STEPS_A_SECOND);
    app.insert_resource(TimeUpdateStrategy::ManualDuration(step));
    app.insert_resource(Gravity(Vec3::new(0.0, -9.75, 1.11)));
    app.init_resource::<Score>();
    app.add_systems(FixedUpdate, (move_paddle, count_points, serve).chain());
    app.finish();
    set_up(&mut app);

    for _ in 0..(20.0 * STEPS_A_SECOND) as u32 {
        app.update();
        let mut balls = app.world_mut().query_filtered::<(Entity, &Transform), With<Ball>>();
        let is_outside = |place: Vec3| place.x.abs() >= 0.25 || place.z.abs() >= 0.5;
        let found: Vec<(Entity, &Transform)> = balls.iter(app.world()).collect();
        let outside = found.iter().find(|(_, place)| is_outside(place.translation));
        if let Some(&(ball, _)) = outside {
            app.world_mut().despawn(ball);
            app.world_mut().resource_mut::<Score>().lost += 1;
        }
    }
    let score = app.world().resource::<Score>();
    println!(
        "{} points, {} balls drained, {} left the table",
        score.points, score.drained, score.lost
    );
    println!("hardest impact {:.2} N s", score.hardest_impulse);
}

fn set_up(app: &mut App) {
    let hard = (RigidBody::Static, Restitution::new(0.8));
    let world = app.world_mut();
    let walls = [
        (Vec3::X, 0.25),
        (Vec3::NEG_X, 0.25),
        (Vec3::Y, 0.03),
        (Vec3::NEG_Y, 0.03),
        (Vec3::Z, 0.5),
        (Vec3::NEG_Z, 0.5),
    ];
    for (axis, distance) in walls {
        let place = Transform::from_translation(-distance * axis);
        world.spawn((hard, Collider::half_space(axis), place));
    }
    for (x, z) in [(-0.1, -0.2), (0.1, -0.2), (0.0, -0.33)] {
        // There is no kick; more than all of the speed comes back instead.
        let bumper = (RigidBody::Static, Collider::cylinder(0.03, 0.06), Restitution::new(1.5));
        world.spawn((Bumper, bumper, CollisionEventsEnabled, Transform::from_xyz(x, 0.0, z)));
    }
    let paddle = (RigidBody::Kinematic, Collider::cuboid(0.12, 0.06, 0.02), Restitution::new(0.8));
    world.spawn((Paddle, paddle, Transform::from_xyz(0.0, 0.0, 0.38)));
    let drain = (RigidBody::Static, Sensor, Collider::cuboid(0.5, 0.06, 0.02));
    world.spawn((Drain, drain, CollisionEventsEnabled, Transform::from_xyz(0.0, 0.0, 0.49)));
}

/// Follows the ball and strikes when it is near, by a velocity that balls feel.
fn move_paddle(
    balls: Query<&Transform, (With<Ball>, Without<Paddle>)>,
    mut paddle: Single<(&Transform, &mut LinearVelocity), With<Paddle>>,
) {
    let (place, velocity) = &mut *paddle;
    let Some(ball) = balls.iter().next() else {
        velocity.0 = Vec3::ZERO;
        return;
    };
    let way = (ball.translation.x - place.translation.x).clamp(-0.01, 0.01);
    let way = (place.translation.x + way).clamp(-0.16, 0.16) - place.translation.x;
    let is_near = ball.translation.z > 0.3 && ball.translation.z < place.translation.z;
    let z = if is_near { (place.translation.z - 0.01).max(0.34) } else { 0.38 };
    velocity.0 = Vec3::new(way, 0.0, z - place.translation.z) * STEPS_A_SECOND as f32;
}

fn count_points(
    mut commands: Commands,
    mut started: MessageReader<CollisionStart>,
    collisions: Collisions,
    bumpers: Query<(), With<Bumper>>,
    drains: Query<(), With<Drain>>,
    balls: Query<(), With<Ball>>,
    mut score: ResMut<Score>,
) {
    for event in started.read() {
        let pair = [event.collider1, event.collider2];
        if pair.iter().any(|&it| bumpers.contains(it)) {
            score.points += 10;
        }
        if pair.iter().any(|&it| drains.contains(it)) {
            score.drained += 1;
            if let Some(&ball) = pair.iter().find(|&&it| balls.contains(it)) {
                commands.entity(ball).despawn();
            }
        }
    }
    let impulses = collisions.iter().map(|pair| pair.max_normal_impulse_magnitude());
    score.hardest_impulse = impulses.fold(score.hardest_impulse, f32::max);
}

/// Serves a ball where there is none.
fn serve(mut commands: Commands, balls: Query<(), With<Ball>>, score: Res<Score>) {
    if balls.is_empty() {
        let body =
            (RigidBody::Dynamic, Collider::sphere(RADIUS), Mass(0.08), Restitution::new(0.9));
        let velocity = LinearVelocity(Vec3::new(0.3 + 0.1 * score.drained as f32, 0.0, -3.0));
        let place = Transform::from_xyz(0.2, -0.0165, 0.3);
        commands.spawn((Ball, body, SweptCcd::default(), velocity, place));
    }
}
