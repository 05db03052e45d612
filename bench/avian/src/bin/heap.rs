//! `bevy/examples/heap.rs` under Avian.

use avian3d::prelude::*;
use bevy::prelude::*;
use bevy::time::TimeUpdateStrategy;

const RADIUS: f32 = 0.1;

fn main() {
    let mut app = App::new();
    app.add_plugins((MinimalPlugins, TransformPlugin, PhysicsPlugins::default()));
    app.insert_resource(Time::<Fixed>::from_hz(64.0));
    let step = std::time::Duration::from_secs_f64(1.0 / 64.0);
    app.insert_resource(TimeUpdateStrategy::ManualDuration(step));
    app.finish();
    fill(&mut app);

    // The first update has no time in it.
    for _ in 0..641 {
        app.update();
    }

    let mut balls = app.world_mut().query_filtered::<(&Position, &LinearVelocity), With<Ball>>();
    let places: Vec<Vec3> = balls.iter(app.world()).map(|(place, _)| place.0).collect();
    let fastest = balls.iter(app.world()).map(|(_, it)| it.length()).fold(0.0, f32::max);
    let overlap = largest_overlap(&places) / RADIUS;
    println!("fastest ball {fastest:.1e} m/s; overlap {overlap:.1e} r");
    let inside = places.iter().filter(|place| place.abs().max_element() < 1.0).count();
    println!("{inside} of 200 balls in the box");
}

#[derive(Component, Clone)]
struct Ball;

/// A box of two metres and balls above its floor, each second layer shifted.
fn fill(app: &mut App) {
    let surface = (Restitution::new(0.3), Friction::new(0.5));
    for axis in [Vec3::Y, Vec3::X, Vec3::NEG_X, Vec3::Z, Vec3::NEG_Z] {
        let wall = (RigidBody::Static, Collider::half_space(axis), surface);
        app.world_mut().spawn((wall, Transform::from_translation(-axis)));
    }
    let ball = (Ball, RigidBody::Dynamic, Collider::sphere(RADIUS), ColliderDensity(2500.0));
    for i in 0..200_u16 {
        let (layer, cell) = (i / 25, i % 25);
        let shift = 0.02 * f32::from(layer % 2);
        let x = 0.25 * f32::from(cell % 5) - 0.5 + shift;
        let z = 0.25 * f32::from(cell / 5) - 0.5 + shift;
        let place = Transform::from_xyz(x, 0.21 * f32::from(layer) - 0.8, z);
        app.world_mut().spawn((ball.clone(), surface, place));
    }
}

/// The largest overlap of balls with each other and the box \[m\].
fn largest_overlap(places: &[Vec3]) -> f32 {
    let mut overlap = 0.0_f32;
    for (i, place) in places.iter().enumerate() {
        for other in &places[..i] {
            overlap = overlap.max(2.0 * RADIUS - place.distance(*other));
        }
        for side in [place.x.abs(), place.z.abs(), -place.y] {
            overlap = overlap.max(side + RADIUS - 1.0);
        }
    }
    overlap
}
