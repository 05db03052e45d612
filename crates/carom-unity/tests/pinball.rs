//! The scene of `examples/pinball-unity` has the colliders of `examples/pinball/table.toml`, by which the game plays.

mod fixtures;

use std::path::Path;

use carom::DQuat;
use carom_scene::Scene;
use carom_scene::scene::{Collider, Shape};
use carom_unity::{Imported, Options, Project, import};

/// Unity's numbers have 24 bits; those of the table are below 1 m and have six digits.
const ACCURACY: f64 = 2e-6;

fn examples() -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples")
}

fn of_unity() -> Imported {
    let path = examples().join("pinball-unity/Assets/Pinball.unity");
    import(&path, &Project::around(&path).unwrap(), &Options::default()).unwrap()
}

fn of_table() -> Scene {
    let text = std::fs::read_to_string(examples().join("pinball/table.toml")).unwrap();
    Scene::from_toml(&text, "table.toml").unwrap()
}

/// The kind of a shape with its lengths \[m\].
fn lengths(shape: &Shape) -> (&'static str, Vec<f64>) {
    match shape {
        Shape::Box { size } => ("box", size.to_vec()),
        Shape::Sphere { radius } => ("sphere", vec![*radius]),
        Shape::Capsule { radius, length } => ("capsule", vec![*radius, *length]),
        Shape::Rectangle { size_x, size_z } => ("rectangle", vec![*size_x, *size_z]),
        other => panic!("{other:?} is not in the table"),
    }
}

#[track_caller]
fn assert_alike(found: &Collider, wanted: &Collider) {
    let ((kind, found_lengths), (wanted_kind, wanted_lengths)) =
        (lengths(&found.shape), lengths(&wanted.shape));
    assert_eq!((kind, found.trigger), (wanted_kind, wanted.trigger), "{}", wanted.name);
    let turn = |it: &Collider| DQuat::from_array(it.rotation).normalize();
    let away = 1.0 - turn(found).dot(turn(wanted)).abs();
    let pairs = found_lengths.iter().zip(&wanted_lengths);
    let pairs = pairs.chain(found.position.iter().zip(&wanted.position));
    for (number, other) in pairs {
        assert!((number - other).abs() < ACCURACY, "{}: {number} {other}", wanted.name);
    }
    assert!(away < ACCURACY * ACCURACY, "{}: {away}", wanted.name);
}

#[test]
fn the_scene_has_the_colliders_of_the_table() {
    let (unity, table) = (of_unity().scene, of_table());
    assert_eq!(unity.colliders.len(), table.colliders.len());
    for wanted in &table.colliders {
        let found = unity.colliders.iter().find(|it| it.name == wanted.name);
        assert_alike(found.unwrap_or_else(|| panic!("no {}", wanted.name)), wanted);
    }
}

#[test]
fn what_is_only_drawn_or_heard_is_listed() {
    assert_eq!(
        fixtures::reasons(&of_unity()),
        [
            "Main Camera: AudioListener: has no counterpart",
            "Table: script: PinballGame.cs is not known; its fields are ball, plunger, flippers, lamps, speaker",
            "Table: AudioSource: has no counterpart",
            "Table/gate/gate plate and 3 more: mesh: is only drawn: it has no collider",
        ]
    );
}
