//! Motions of colliders of scene files reach the world, are written again, and wrong ones are refused with their line.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, PI};

use carom::{DQuat, DVec3, Keyframe, MotionPart};
use carom_scene::Scene;

const TEXT: &str = "name = 'shaken'
[[colliders]]
shape = 'half-space'
position = [0, -1, 0]
motion = { oscillate = { amplitude = '2 mm', frequency = '50 Hz', phase_degrees = 90 } }

[[colliders]]
shape = { box = { size = [1, 0.1, 1] } }
motion = [
    { turn = { axis = [0, 0, 1], pivot = [0.5, 0, 0], rate = '90 deg/s' } },
    { swing = { axis = [0, 0, 2], amplitude_degrees = 180, frequency = 0.5 } },
    { steady = { velocity = [1, 0, 0] } },
]
";

fn read(text: &str) -> Scene {
    Scene::from_toml(text, "shaken.toml").unwrap()
}

#[test]
fn motions_reach_the_world_in_its_units() {
    let world = read(TEXT).world().unwrap();
    let colliders: Vec<carom::Collider> = world.colliders().map(|(_, it)| it.clone()).collect();
    let oscillate = MotionPart::Oscillate {
        axis: DVec3::Y,
        amplitude: 0.002,
        frequency: 50.0,
        phase: FRAC_PI_2,
    };
    assert_eq!(colliders[0].motion.parts(), [oscillate]);
    // At its highest.
    assert_eq!(colliders[0].pose.position, DVec3::new(0.0, -0.998, 0.0));
    let pivot = DVec3::new(0.5, 0.0, 0.0);
    let turn = MotionPart::Turn { axis: DVec3::Z, pivot, rate: FRAC_PI_2 };
    let swing = MotionPart::Swing {
        axis: 2.0 * DVec3::Z,
        pivot: DVec3::ZERO,
        amplitude: PI,
        frequency: 0.5,
        phase: 0.0,
    };
    let steady = MotionPart::Steady { velocity: DVec3::X };
    assert_eq!(colliders[1].motion.parts(), [turn, swing, steady]);
}

#[test]
fn a_written_scene_has_them_again_and_no_defaults() {
    let scene = read(TEXT);
    let written = scene.to_toml();
    assert_eq!(read(&written), scene);
    assert_eq!(written.matches("phase_degrees").count(), 1, "{written}");
    assert_eq!(written.matches("pivot").count(), 1, "{written}");
}

#[test]
fn a_scene_that_begins_later_goes_on_with_the_motion() {
    let scene = read(TEXT);
    let mut world = scene.world().unwrap();
    world.set_time(0.7).unwrap();
    let now =
        |(described, (_, collider)): (&carom_scene::scene::Collider, (_, &carom::Collider))| {
            described.now(collider).beginning_at(0.7)
        };
    let colliders = scene.colliders.iter().zip(world.colliders()).map(now).collect();
    let later = Scene { colliders, ..scene.clone() }.world().unwrap();
    for ((_, a), (_, b)) in world.colliders().zip(later.colliders()) {
        assert!((a.pose.position - b.pose.position).length() < 1e-13, "{a:?} {b:?}");
        assert!((a.pose.rotation - b.pose.rotation).length() < 1e-13, "{a:?} {b:?}");
        assert!((a.velocity - b.velocity).length() < 1e-12, "{a:?} {b:?}");
    }
}

const LIFT: &str = "name = 'lift'
[[colliders]]
shape = 'half-space'
position = [0, -1, 0]

[colliders.motion.keyframes]
times = ['500 ms', 2, 3]
positions = [[0, 0, 0], [0, '20 cm', 0], [0, 0, 0]]
rotations = [[0, 0, 0, 1], { axis = [0, 0, 1], degrees = 90 }, [0, 0, 0, 1]]
pivot = [0.5, 0, 0]
repeat = true
";

#[test]
fn keyframes_reach_the_world_and_are_written_again() {
    let scene = read(LIFT);
    let world = scene.world().unwrap();
    let (_, floor) = world.colliders().next().unwrap();
    let Some(MotionPart::Keyframes(found)) = floor.motion.parts().first() else { panic!() };
    let middle = Keyframe::at(2.0, DVec3::new(0.0, 0.2, 0.0));
    let turned = DQuat::from_xyzw(0.0, 0.0, FRAC_1_SQRT_2, FRAC_1_SQRT_2);
    let ends = [0.5, 3.0].map(|time| Keyframe::at(time, DVec3::ZERO));
    let expected = [ends[0], middle.rotated(turned), ends[1]];
    for (found, expected) in found.keyframes().iter().zip(expected) {
        assert_eq!((found.time, found.position), (expected.time, expected.position));
        // The sine and the cosine of 45°.
        assert!((found.rotation - expected.rotation).length() < 1e-15);
    }
    assert!(found.repeats());
    assert_eq!(found.pivot(), DVec3::new(0.5, 0.0, 0.0));
    assert_eq!(read(&scene.to_toml()), scene);
    let later = scene.colliders[0].beginning_at(0.7);
    let later = Scene { colliders: vec![later], ..scene.clone() }.world().unwrap();
    let mut world = scene.world().unwrap();
    world.set_time(0.7).unwrap();
    let [now, then] = [&world, &later].map(|it| it.colliders().next().unwrap().1.pose);
    // A rounding of the times.
    assert!((now.position - then.position).length() < 1e-15, "{now:?} {then:?}");
}

#[test]
fn two_motions_in_one_table_are_refused_as_several_things() {
    let both = "motion = { steady = { velocity = [1, 0, 0] }, turn = { rate = 1 } }";
    let text = format!("[[colliders]]\nshape = 'half-space'\n{both}");
    let said = Scene::from_toml(&text, "two.toml").unwrap_err().to_string();
    assert!(said.contains("colliders[0].motion: has several entries"), "{said}");
}

#[test]
fn wrong_keyframes_are_refused_with_their_line() {
    let expect = |from: &str, to: &str, parts: [&str; 2]| {
        assert!(LIFT.contains(from));
        let said = match Scene::from_toml(&LIFT.replace(from, to), "lift.toml") {
            Ok(scene) => scene.world().unwrap_err().to_string(),
            Err(error) => error.to_string(),
        };
        assert!(parts.iter().all(|part| said.contains(part)), "{said}");
    };
    let field = |name: &str| format!("colliders[0].motion.keyframes.{name}");
    expect("2, 3]", "2]", [&field("positions"), "2 times"]);
    expect(", [0, 0, 0, 1]]", "]", [&field("rotations"), "lift.toml:9"]);
    expect("2, 3]", "2, 1]", [&field("times"), "ascending"]);
    expect("[0, 0, 0]]", "[0, 1, 0]]", [&field("positions"), "repeats"]);
    expect("'500 ms'", "'500 m'", ["lift.toml:7", "not in s"]);
    expect("'20 cm'", "'20 s'", ["lift.toml:8", "not in m"]);
    expect("pivot = [0.5, 0, 0]", "pivot = [inf, 0, 0]", [&field("pivot"), "lift.toml:10"]);
    expect("repeat", "repeated", ["repeat", "lift.toml:11"]);
}

#[test]
fn wrong_ones_are_refused_with_their_line() {
    let refusal = |from: &str, to: &str| {
        assert!(TEXT.contains(from));
        match Scene::from_toml(&TEXT.replace(from, to), "shaken.toml") {
            Ok(scene) => scene.world().unwrap_err().to_string(),
            Err(error) => error.to_string(),
        }
    };
    let expect = |said: String, line: &str, field: &str| {
        assert!(said.contains(&format!("shaken.toml:{line}")) && said.contains(field), "{said}");
    };
    expect(refusal("'50 Hz'", "-1"), "5", "colliders[0].motion.oscillate.frequency");
    expect(refusal("'50 Hz'", "'50 m'"), "5", "Hz");
    expect(refusal("axis = [0, 0, 1], ", "axis = [0, 0, 0], "), "10", "motion[0].turn.axis");
    expect(refusal("= 180", "= inf"), "11", "motion[1].swing.amplitude_degrees");
    expect(refusal("amplitude =", "amplitud ="), "5", "amplitude");
    let both = refusal("position = [0, -1, 0]", "velocity = [0, -1, 0]");
    expect(both, "4", "colliders[0].velocity");
}
