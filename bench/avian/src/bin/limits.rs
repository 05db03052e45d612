//! Under Avian, what the tests of `bevy/tests/bodies.rs` claim: a fast ball before a thin wall, and the energy of
//! elastic balls.

use avian3d::dynamics::solver::SolverConfig;
use avian3d::prelude::*;
use bevy::prelude::*;
use bevy::time::TimeUpdateStrategy;

fn main() {
    for speed in [100.0, 1_000.0, 10_000.0] {
        let [swept, plain] = [true, false].map(|is_swept| passes(speed, is_swept));
        println!("{speed} m/s: passes a wall of 1 mm: {plain}; with SweptCcd: {swept}");
    }
    println!("energy of 27 elastic balls after 60 s, to that before: {}", energy_kept());
}

fn app() -> App {
    let mut app = App::new();
    app.add_plugins((MinimalPlugins, TransformPlugin, PhysicsPlugins::default()));
    app.insert_resource(Time::<Fixed>::from_hz(64.0));
    let step = std::time::Duration::from_secs_f64(1.0 / 64.0);
    app.insert_resource(TimeUpdateStrategy::ManualDuration(step));
    app.insert_resource(Gravity(Vec3::ZERO));
    // Slow impacts bounce, too: the default is 1 m/s.
    app.insert_resource(SolverConfig { restitution_threshold: 0.0, ..default() });
    app.finish();
    app
}

fn ball(radius: f32) -> impl Bundle {
    let surface = (Restitution::new(1.0), Friction::new(0.0));
    (RigidBody::Dynamic, Collider::sphere(radius), Mass(1.0), surface)
}

/// Whether a ball passes a wall of 1 mm.
fn passes(speed: f32, is_swept: bool) -> bool {
    let mut app = app();
    let wall = (RigidBody::Static, Collider::cuboid(0.001, 4.0, 4.0), Restitution::new(1.0));
    app.world_mut().spawn((wall, Transform::from_xyz(5.0, 0.0, 0.0)));
    let velocity = LinearVelocity(Vec3::X * speed);
    let ball = app.world_mut().spawn((ball(0.05), velocity)).id();
    if is_swept {
        app.world_mut().entity_mut(ball).insert(SweptCcd::default());
    }
    for _ in 0..65 {
        app.update();
    }
    app.world().get::<Position>(ball).is_some_and(|place| place.x > 5.0)
}

/// Kinetic energy of elastic balls in a box after a minute, divided by that at the start.
fn energy_kept() -> f32 {
    let mut app = app();
    for axis in [Vec3::Y, Vec3::NEG_Y, Vec3::X, Vec3::NEG_X, Vec3::Z, Vec3::NEG_Z] {
        let wall = (RigidBody::Static, Collider::half_space(axis), Restitution::new(1.0));
        let place = Transform::from_translation(-axis);
        app.world_mut().spawn((wall, Friction::new(0.0), place));
    }
    for i in 0..27_u8 {
        let [x, y, z] = [i % 3, i / 3 % 3, i / 9].map(|it| 0.5 * f32::from(it) - 0.5);
        let velocity = LinearVelocity(Vec3::new(1.0 + x, 2.0 * y, -z));
        app.world_mut().spawn((ball(0.125), velocity, Transform::from_xyz(x, y, z)));
    }
    let energy = |app: &mut App| -> f32 {
        let mut balls = app.world_mut().query::<&LinearVelocity>();
        balls.iter(app.world()).map(|it| it.length_squared()).sum()
    };
    let before = energy(&mut app);
    for _ in 0..3841 {
        app.update();
    }
    energy(&mut app) / before
}
