//! A heap: 200 balls fall into a box and come to rest.
//!
//! `cargo run --release --example heap` runs ten seconds without a window and prints the energy, the speed and the
//! overlap at the end.

use bevy_app::App;
use bevy_ecs::prelude::*;
use bevy_time::{Fixed, Time, TimePlugin};
use bevy_transform::TransformPlugin;
use bevy_transform::components::Transform;
use carom_bevy::carom::{Contact, Rule, Settings};
use carom_bevy::prelude::*;

const RADIUS: f64 = 0.1;

fn main() {
    let mut app = App::new();
    let mut settings = Settings::default();
    settings.rule = Rule::Contact(Contact::default());
    app.add_plugins((TimePlugin, TransformPlugin, CaromPlugin::new(settings)));
    app.insert_resource(Time::<Fixed>::from_hz(64.0));
    fill(&mut app);

    let mut impacts = 0;
    for _ in 0..640 {
        app.world_mut().step_physics();
        impacts += app.world().resource::<CaromWorld>().report().impacts.len();
    }

    let physics = app.world().resource::<CaromWorld>();
    let overlap = physics.overlaps(0.0).iter().map(|it| it.depth).fold(0.0, f64::max);
    let fastest = physics.spheres().velocities().iter().map(|it| it.length()).fold(0.0, f64::max);
    println!(
        "{impacts} impacts; fastest ball {fastest:.1e} m/s; overlap {:.1e} r",
        overlap / RADIUS
    );
    let mut balls = app.world_mut().query_filtered::<&Transform, With<Ball>>();
    let is_inside = |place: &&Transform| place.translation.abs().max_element() < 1.0;
    let inside = balls.iter(app.world()).filter(is_inside).count();
    println!("{inside} of 200 balls in the box");
    assert_eq!(inside, 200);
}

/// A box of two metres and balls above its floor, each second layer shifted.
fn fill(app: &mut App) {
    let walls = Collider::open_box(2.0, 2.0, 2.0);
    app.world_mut().spawn(walls.with(|it| it.with_restitution(0.3).with_friction(0.5)));
    let ball = Ball::new(RADIUS);
    let ball = ball.with(|it| it.with_density(2500.0).with_restitution(0.3).with_friction(0.5));
    for i in 0..200_u16 {
        let (layer, cell) = (i / 25, i % 25);
        let shift = 0.02 * f32::from(layer % 2);
        let x = 0.25 * f32::from(cell % 5) - 0.5 + shift;
        let z = 0.25 * f32::from(cell / 5) - 0.5 + shift;
        app.world_mut().spawn((ball, Transform::from_xyz(x, 0.21 * f32::from(layer) - 0.8, z)));
    }
}
