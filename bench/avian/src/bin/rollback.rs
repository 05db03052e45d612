//! `bevy/examples/rollback.rs` under Avian, which has no snapshots: the program keeps the components itself. What the
//! solver keeps from step to step (contacts, sleep) is not among them.

use std::collections::VecDeque;

use avian3d::prelude::*;
use bevy::prelude::*;

const FRAMES: usize = 300;
const DELAY: usize = 8;

fn main() {
    let truth: Vec<f32> = (0..FRAMES).map(input).collect();
    let (mut app, paddle) = game();
    play(&mut app, paddle, &truth, &mut VecDeque::new());
    let at_once = state(&mut app);
    let (mut app, paddle) = game();
    play(&mut app, paddle, &truth, &mut VecDeque::new());
    println!("without rollback, equal: {}", at_once == state(&mut app));

    let (mut app, paddle) = game();
    let mut played: Vec<f32> = Vec::new();
    let mut kept = VecDeque::from([state(&mut app)]);
    let mut rollbacks = 0;
    for frame in 0..FRAMES + DELAY {
        if frame < FRAMES {
            let guess = played.last().copied().unwrap_or(-0.75);
            play(&mut app, paddle, &[guess], &mut kept);
            played.push(guess);
        }
        let Some(known) = frame.checked_sub(DELAY) else { continue };
        if played[known] != truth[known] {
            played[known..].fill(truth[known]);
            kept.truncate(known + 1);
            let before = kept.back().cloned().expect("it is kept");
            restore(&mut app, &before);
            play(&mut app, paddle, &played[known..], &mut kept);
            rollbacks += 1;
        }
    }
    let late = state(&mut app);
    let farthest = at_once.iter().zip(&late).map(|(a, b)| a.1.distance(*b.1)).fold(0.0, f32::max);
    println!("{rollbacks} rollbacks; equal: {}; farthest ball {farthest:.1e} m", at_once == late);
}

type State = Vec<(Entity, Position, Rotation, LinearVelocity, AngularVelocity)>;

fn state(app: &mut App) -> State {
    let mut bodies =
        app.world_mut()
            .query::<(Entity, &Position, &Rotation, &LinearVelocity, &AngularVelocity)>();
    let found = bodies.iter(app.world());
    let mut state: State = found.map(|(e, p, r, v, w)| (e, *p, *r, *v, *w)).collect();
    state.sort_by_key(|it| it.0.index_u32());
    state
}

fn restore(app: &mut App, state: &State) {
    for &(entity, position, rotation, velocity, angular_velocity) in state {
        let place = Transform::from_translation(position.0).with_rotation(rotation.0);
        let parts = (position, rotation, velocity, angular_velocity, place);
        app.world_mut().entity_mut(entity).insert(parts);
    }
}

fn game() -> (App, Entity) {
    let mut app = App::new();
    app.add_plugins((MinimalPlugins, TransformPlugin, PhysicsPlugins::default()));
    app.insert_resource(Time::<Fixed>::from_hz(64.0));
    app.finish();
    let world = app.world_mut();
    for axis in [Vec3::Y, Vec3::X, Vec3::NEG_X, Vec3::Z, Vec3::NEG_Z] {
        let wall = (RigidBody::Static, Collider::half_space(axis), Restitution::new(0.8));
        world.spawn((wall, Transform::from_translation(-axis)));
    }
    for i in 0..20_u8 {
        let ball = (RigidBody::Dynamic, Collider::sphere(0.08), Mass(1.0));
        let surface = (Restitution::new(0.9), Friction::new(0.2));
        let (x, y) = (0.3 * f32::from(i % 5) - 0.6, 0.25 * f32::from(i / 5) - 0.3);
        world.spawn((ball, surface, Transform::from_xyz(x + 0.1 * y, y, 0.05 * x)));
    }
    let paddle = (RigidBody::Kinematic, Collider::cuboid(0.6, 0.1, 0.6));
    let paddle = world.spawn((paddle, Transform::from_xyz(0.0, -0.75, 0.0))).id();
    step(world);
    (app, paddle)
}

fn input(frame: usize) -> f32 {
    if frame % 48 < 8 { -0.55 } else { -0.75 }
}

fn play(app: &mut App, paddle: Entity, inputs: &[f32], kept: &mut VecDeque<State>) {
    for &height in inputs {
        let now = app.world().get::<Position>(paddle).map_or(0.0, |it| it.y);
        if let Some(mut velocity) = app.world_mut().get_mut::<LinearVelocity>(paddle) {
            velocity.0 = Vec3::Y * (height - now) * 64.0;
        }
        step(app.world_mut());
        kept.push_back(state(app));
    }
}

/// Takes one step by hand.
fn step(world: &mut World) {
    let mut fixed = *world.resource::<Time<Fixed>>();
    fixed.advance_by(fixed.timestep());
    *world.resource_mut::<Time>() = fixed.as_generic();
    *world.resource_mut::<Time<Fixed>>() = fixed;
    world.run_schedule(FixedPostUpdate);
}
