//! The card of a scene, with the sliders that the scene names.

use carom_scene::{Scene, Source};
use carom_session::Command;
use carom_view::{Setup, Start};
use egui::Key;
use egui::accesskit::Role;
use egui_kittest::kittest::Queryable;

use crate::desk::{Desk, desk, desk_of, press, scene, setup, watching, watching_at};

const SCENE: &str = r#"
name = "drop"
title = "A drop"
description = "It falls. It never comes back."
spheres = [{ position = [0, 3, 0], radius = 0.5 }, { position = [2, 3, 0], radius = 0.5 }]
[[forces]]
gravity = { acceleration = [0, -9.81, 0] }
[[colliders]]
name = "floor"
shape = "half-space"
restitution = 0.5
[[try]]
text = "Make the floor bouncy"
path = "colliders.0.restitution"
range = [0, 1]
[[try]]
text = "Drop a larger ball"
path = "spheres.0.radius"
range = [0.1, 0.8]
[[try]]
text = "Nothing is there"
path = "springs.7.stiffness"
range = [0, 1]
"#;

fn dropping() -> Desk {
    let scene = Scene::from_toml(SCENE, "drop.toml").expect("a scene");
    let start = Some(Start::Scene(Box::new(scene), Source::Registered));
    desk(Setup { start, ..setup() })
}

/// Moves the slider with this label by keys, by a hundredth of its range each.
fn move_slider(desk: &mut Desk, label: &str, key: Key, count: usize) {
    desk.get_by_role_and_label(Role::Slider, label).focus();
    desk.run_steps(2);
    for _ in 0..count {
        desk.key_press(key);
        desk.run_steps(1);
    }
    desk.run_steps(3);
}

#[test]
fn the_card_has_title_sentence_and_a_slider_for_each_number_that_is_there() {
    let desk = dropping();
    desk.get_by_label("It falls.");
    desk.get_by_label("Try this:");
    desk.get_by_role_and_label(Role::Slider, "Make the floor bouncy");
    desk.get_by_role_and_label(Role::Slider, "Drop a larger ball");
    assert!(desk.query_by_label("Nothing is there").is_none());
}

#[test]
fn a_coefficient_changes_while_the_scene_runs_and_is_undone() {
    let mut desk = dropping();
    press(&mut desk, Key::P);
    desk.run_steps(10);
    move_slider(&mut desk, "Make the floor bouncy", Key::ArrowRight, 3);
    let view = scene(&desk).view();
    let changed = view.setup.colliders[0].1.restitution;
    assert!(changed > 0.5, "{changed}");
    assert!(view.playback.playing && view.time > 0.1 && view.undoable > 0, "it went on");
    desk.state_mut().command(Command::Undo);
    desk.run_steps(4);
    assert_eq!(scene(&desk).view().setup.colliders[0].1.restitution, 0.5);
}

#[test]
fn a_number_of_the_beginning_starts_the_scene_again_with_other_edits_kept() {
    let mut desk = dropping();
    press(&mut desk, Key::P);
    move_slider(&mut desk, "Make the floor bouncy", Key::ArrowRight, 2);
    let restitution = scene(&desk).view().setup.colliders[0].1.restitution;
    desk.run_steps(20);
    let before = scene(&desk).view().time;
    move_slider(&mut desk, "Drop a larger ball", Key::ArrowRight, 2);
    let view = scene(&desk).view();
    assert!(view.spheres.radii[0] > 0.5, "{:?}", view.spheres.radii);
    assert_eq!(view.spheres.radii[1], 0.5);
    assert_eq!(view.setup.colliders[0].1.restitution, restitution);
    assert!(view.time < before, "{} {before}", view.time);
}

#[test]
fn the_card_closes_and_opens_again() {
    let mut desk = dropping();
    desk.get_by_label("Close the card").click();
    desk.run_steps(3);
    assert!(desk.query_by_label("Try this:").is_none());
    desk.get_by_label("Try this").click();
    desk.run_steps(3);
    desk.get_by_label("Try this:");
}

#[test]
fn in_a_small_window_the_card_is_a_button_and_stays_within_when_open() {
    for size in [[390.0, 844.0], [844.0, 390.0]] {
        let mut desk = watching_at(size, "bounce");
        assert!(desk.query_by_label("Try this:").is_none());
        desk.get_by_label("Try this").click();
        desk.run_steps(4);
        let close = desk.get_by_label("Close the card").rect();
        let text = desk.get_by_role_and_label(Role::Slider, "Make the floor less bouncy").rect();
        assert!(close.right() <= size[0] && text.right() <= size[0] && text.bottom() <= size[1]);
    }
}

#[test]
fn scenes_without_suggestions_and_two_rules_have_no_card() {
    let desk = watching("simtest1");
    assert!(desk.query_by_label("Try this:").is_none());
    let mut desk =
        desk_of([1280.0, 800.0], Setup { start: crate::desk::start("bounce"), ..setup() });
    desk.get_by_label("Try this:");
    press(&mut desk, Key::X);
    assert!(desk.query_by_label("Try this:").is_none());
}
