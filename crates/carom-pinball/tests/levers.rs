//! Flippers and plungers move as their keyframes say, and throw a ball by the closed form of an impact.

use carom::DVec3;
use carom_pinball::{Game, Keys, Table, TableError};
use carom_scene::scene::{Collider, Force, Motion, Scene, Shape, Sphere};

/// A change of a scene.
type Change = fn(&mut Scene);

const RADIUS: f64 = 0.0135;
/// Acceleration down the table \[m/s²\].
const DOWN: f64 = 1.1;
const RESTITUTION: f64 = 0.5;
/// Time from rest to pressed \[s\], and angle \[rad\].
const STROKE: (f64, f64) = (1.0 / 30.0, 1.0);
/// Half length and half thickness of a flipper \[m\].
const FLIPPER: [f64; 2] = [0.04, 0.009];

/// Returns a collider whose first three keyframes are these poses at rest, pressed, and back.
fn lever(name: &str, pivot: [f64; 3], turn: f64, position: [f64; 3]) -> Collider {
    let size = [2.0 * FLIPPER[0], 0.03, 2.0 * FLIPPER[1]];
    let (sine, cosine) = libm::sincos(0.5 * turn);
    let rest = [0.0, 0.0, 0.0, 1.0];
    let motion = Motion::Keyframes {
        times: vec![0.0, STROKE.0, 0.1],
        positions: Vec::new(),
        rotations: vec![rest, [0.0, sine, 0.0, cosine], rest],
        pivot,
        repeat: false,
    };
    let motion = vec![motion];
    let shape = Shape::Box { size };
    Collider {
        name: name.to_owned(),
        position,
        motion,
        restitution: RESTITUTION,
        ..Collider::new(shape)
    }
}

/// Returns a table with level flippers and a ball that rests on the left one, `arm` from its pivot \[m\].
fn level(arm: f64) -> Scene {
    let mut scene = Scene::new("level");
    scene.simulation.frame_time = 1.0 / 60.0;
    scene.forces = vec![Force::Gravity { acceleration: [0.0, -9.8, DOWN] }];
    let floor = Shape::Box { size: [1.0, 0.1, 1.0] };
    let floor = Collider { position: [0.0, -0.05, 0.0], restitution: 0.0, ..Collider::new(floor) };
    let drain = Shape::Box { size: [1.0, 0.1, 0.1] };
    let drain = Collider {
        name: "drain".to_owned(),
        position: [0.0, 0.0, 0.4],
        trigger: true,
        capture: true,
        ..Collider::new(drain)
    };
    let [half, thickness] = FLIPPER;
    let turn = STROKE.1;
    scene.colliders = vec![
        floor,
        drain,
        lever("left flipper", [-half, 0.0, 0.0], turn, [half, 0.015, 0.0]),
        lever("right flipper", [half, 0.0, 0.0], -turn, [4.0 * half, 0.015, 0.0]),
    ];
    scene.spheres = vec![Sphere {
        radius: Some(RADIUS),
        ..Sphere::at([arm, RADIUS, -thickness - RADIUS], RADIUS)
    }];
    scene
}

fn game(scene: &Scene) -> Game {
    Game::new(Table::from_scene(scene).unwrap()).unwrap()
}

const LEFT: Keys = Keys { left: true, ..Keys::NONE };

#[test]
fn a_flipper_throws_a_resting_ball_with_its_speed_there_times_one_and_restitution() {
    for arm in [0.03, 0.05, 0.07] {
        let mut game = game(&level(arm));
        for _ in 0..10 {
            game.step(Keys::NONE).unwrap();
        }
        let rested = game.world().spheres().get(0);
        // It rests to the rounding of 1 s of gravity.
        assert!(rested.velocity.length() < 1e-12, "{}", rested.velocity);
        game.step(LEFT).unwrap();
        // The surface under the ball moves by the angular speed times the arm; the ball leaves it by (1 + e) of that,
        // and gravity brakes it for a frame.
        let rate = STROKE.1 / STROKE.0;
        let speed = (1.0 + RESTITUTION) * rate * arm - DOWN * game.frame_time();
        let velocity = game.world().spheres().velocities()[0];
        let error = (velocity - DVec3::new(0.0, 0.0, -speed)).length();
        assert!(error < 1e-12 * speed, "{arm}: {velocity} and not {speed}");
    }
}

#[test]
fn a_flipper_reaches_its_pressed_pose_in_the_time_of_its_keyframes_and_comes_back() {
    let mut game = game(&level(0.05));
    let flipper = |game: &Game| game.world().colliders().nth(2).unwrap().1.clone();
    let rest = flipper(&game).pose;
    let angle = |game: &Game| {
        let turned = flipper(game).pose.rotation;
        // A quaternion and its negative are the same rotation.
        2.0 * libm::atan2(turned.y.copysign(turned.y * turned.w), turned.w.abs())
    };
    let mut expected = 0.0;
    // In the last frame it stands.
    let pressed = [true, true, true, true, false, false, true, false, false, false, false, false];
    for pressed in pressed {
        game.step(Keys { left: pressed, ..Keys::NONE }).unwrap();
        // Back takes twice as long as there.
        let step = if pressed { 0.5 } else { -0.25 };
        expected = f64::clamp(expected + step, 0.0, 1.0);
        assert!((angle(&game) - expected * STROKE.1).abs() < 1e-13, "{expected}");
        // It turns about its pivot, which stays.
        let place = flipper(&game).pose;
        let pivot = place.position + place.rotation * DVec3::new(-FLIPPER[0], 0.0, 0.0);
        assert!((pivot - (rest.position - DVec3::new(FLIPPER[0], 0.0, 0.0))).length() < 1e-15);
    }
    // Rounding of the sum of its steps.
    let back = flipper(&game).pose;
    assert!((back.position - rest.position).length() < 1e-15 && angle(&game).abs() < 1e-14);
    assert!(flipper(&game).angular_velocity.length() < 1e-12);
}

#[test]
fn scenes_that_are_no_table_say_what_is_missing() {
    let no_drain = |scene: &mut Scene| scene.colliders[1].capture = false;
    let no_flipper = |scene: &mut Scene| scene.colliders[2].name.clear();
    let no_ball = |scene: &mut Scene| scene.spheres.clear();
    let no_motion = |scene: &mut Scene| scene.colliders[3].motion.clear();
    let no_rest = |scene: &mut Scene| {
        if let [Motion::Keyframes { rotations, .. }] = &mut scene.colliders[3].motion[..] {
            rotations.swap(0, 1);
        }
    };
    let cases: [(Change, &str); 5] = [
        (no_drain, "no trigger with `capture` is named \"drain\""),
        (no_flipper, "no solid collider is named \"left flipper\""),
        (no_ball, "one at least"),
        (no_motion, "the motion of \"right flipper\" has to be keyframes"),
        (no_rest, "the motion of \"right flipper\" has to be keyframes"),
    ];
    for (change, expected) in cases {
        let mut scene = level(0.05);
        change(&mut scene);
        let error: TableError = Table::from_scene(&scene).unwrap_err();
        assert!(error.to_string().contains(expected), "{error}");
    }
    let mut scene = level(0.05);
    scene.spheres[0].radius = Some(-1.0);
    assert!(matches!(Table::from_scene(&scene), Err(TableError::Scene(_))));
}
