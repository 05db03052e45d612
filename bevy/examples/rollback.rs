//! A game over a network: the input of the other player comes eight frames late. The game guesses it, and where the
//! guess was wrong, goes back and plays these frames again. It ends with the bits of a game that knew all input at
//! once.
//!
//! `cargo run --release --example rollback` prints both hashes and the time of a rollback.

use std::time::Instant;

use bevy_app::App;
use bevy_ecs::prelude::*;
use bevy_time::{Fixed, Time, TimePlugin};
use bevy_transform::TransformPlugin;
use bevy_transform::components::Transform;
use carom_bevy::prelude::*;

const FRAMES: usize = 300;
const DELAY: usize = 8;

fn main() {
    let truth: Vec<f32> = (0..FRAMES).map(input).collect();
    let (mut app, paddle) = game();
    play(&mut app, paddle, &truth);
    let at_once = app.world().resource::<CaromWorld>().state_hash();

    let (mut app, paddle) = game();
    let mut played: Vec<f32> = Vec::new();
    let (mut rollbacks, mut slowest) = (0, 0.0_f64);
    for frame in 0..FRAMES + DELAY {
        if frame < FRAMES {
            let guess = played.last().copied().unwrap_or(-0.75);
            play(&mut app, paddle, &[guess]);
            played.push(guess);
        }
        // The true input of an earlier frame arrives.
        let Some(known) = frame.checked_sub(DELAY) else { continue };
        if played[known] != truth[known] {
            played[known..].fill(truth[known]);
            let began = Instant::now();
            // One step was taken before the first frame.
            app.world_mut().roll_back(known as u64 + 1).expect("it is kept");
            slowest = slowest.max(began.elapsed().as_secs_f64());
            play(&mut app, paddle, &played[known..]);
            rollbacks += 1;
        }
    }
    let late = app.world().resource::<CaromWorld>().state_hash();
    println!(
        "{at_once} at once, {late} late; {rollbacks} rollbacks, slowest {:.3} ms",
        1e3 * slowest
    );
    assert_eq!(at_once, late);
}

/// Balls in a box with a paddle in its floor.
fn game() -> (App, Entity) {
    let mut app = App::new();
    app.add_plugins((TimePlugin, TransformPlugin, CaromPlugin::default()));
    app.insert_resource(Time::<Fixed>::from_hz(64.0));
    app.insert_resource(Rollback::new(DELAY + 2));
    let world = app.world_mut();
    world.spawn(Collider::open_box(2.0, 2.0, 2.0).with(|it| it.with_restitution(0.8)));
    for i in 0..20_u8 {
        let ball = Ball::new(0.08).with(|it| it.with_restitution(0.9).with_friction(0.2));
        let (x, y) = (0.3 * f32::from(i % 5) - 0.6, 0.25 * f32::from(i / 5) - 0.3);
        world.spawn((ball, Transform::from_xyz(x + 0.1 * y, y, 0.05 * x)));
    }
    let paddle = (Collider::cuboid(0.6, 0.1, 0.6), Kinematic);
    let paddle = world.spawn((paddle, Transform::from_xyz(0.0, -0.75, 0.0))).id();
    world.step_physics();
    (app, paddle)
}

/// Height of the paddle that the other player wants \[m\].
fn input(frame: usize) -> f32 {
    if frame % 48 < 8 { -0.55 } else { -0.75 }
}

/// Takes a step for each input.
fn play(app: &mut App, paddle: Entity, inputs: &[f32]) {
    for &height in inputs {
        if let Some(mut place) = app.world_mut().get_mut::<Transform>(paddle) {
            place.translation.y = height;
        }
        app.world_mut().step_physics();
    }
}
