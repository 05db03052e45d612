//! Hints over the picture: how to begin, the progress of a seek, where the balls are.

use std::time::Duration;

use carom_scene::Source;
use carom_scene::scene::{Scene, Sphere};
use carom_session::Command;
use carom_view::{Setup, Start};
use egui::Key;
use egui_kittest::kittest::Queryable;

use crate::desk::{
    Desk, choosing, desk, go_to, press, scene, setup, watching, watching_at, watching_on,
};

const LEFT: &str = "All balls have left the picture.";

/// Opens a scene with one ball that flies to the right, sixty radii a second.
fn flying() -> Desk {
    let mut flying = Scene::new("flying");
    let velocity = [30.0, 0.0, 0.0];
    flying.spheres.push(Sphere { velocity, ..Sphere::at([0.0; 3], 0.5) });
    desk(Setup { start: Some(Start::Scene(Box::new(flying), Source::Registered)), ..setup() })
}

#[test]
fn an_embedded_window_has_a_large_button_at_the_start_and_a_large_window_none_over_the_picture() {
    let mut desk = watching_at([440.0, 330.0], "simtest1");
    desk.get_by_label("Play the scene").click();
    desk.run_steps(10);
    assert!(scene(&desk).view().playback.playing && scene(&desk).view().frame > 0);
    assert!(desk.query_by_label("Play the scene").is_none());
    press(&mut desk, Key::P);
    assert!(desk.query_by_label("Play the scene").is_none());
    assert!(watching("simtest1").query_by_label("Play the scene").is_none());
}

/// A scene on the way to a time that it does not reach: a frame has no more time than for one piece of work.
fn on_a_long_way() -> Desk {
    let setup = Setup { inline_budget: Some(Duration::ZERO), ..setup() };
    let mut desk = watching_on(setup, "tutorial4");
    desk.state_mut().command(Command::Seek(1e5));
    desk
}

#[test]
fn escape_ends_the_way_to_another_time_where_it_has_come_to() {
    let mut desk = on_a_long_way();
    desk.run_steps(2);
    assert!(scene(&desk).view().seeking.is_some());
    press(&mut desk, Key::Escape);
    let frame = scene(&desk).view().frame;
    assert!(scene(&desk).view().seeking.is_none() && frame > 0);
    desk.run_steps(5);
    assert_eq!(scene(&desk).view().frame, frame);
}

#[test]
fn the_way_says_how_far_it_is_and_stops_on_a_click() {
    let mut desk = on_a_long_way();
    for _ in 0..1000 {
        desk.run_steps(1);
        if desk.query_by_label("Stop here").is_some() {
            break;
        }
    }
    // The card needs two frames to find its place.
    desk.run_steps(2);
    desk.get_by_label_contains("0 % of the way to 100000.0 s, ");
    desk.get_by_label("Stop here").click();
    desk.run_steps(3);
    assert!(scene(&desk).view().seeking.is_none());
    assert!(desk.query_by_label("Stop here").is_none());
}

#[test]
fn balls_that_have_all_left_can_be_brought_back_into_the_picture() {
    let mut desk = flying();
    assert!(desk.query_by_label(LEFT).is_none());
    // The ball is then a thousand radii away.
    go_to(&mut desk, 20.0);
    // The card needs two frames to find its place.
    desk.run_steps(3);
    desk.get_by_label(LEFT);
    // "Fit" is a button of the bar as well.
    press(&mut desk, Key::Num0);
    desk.run_steps(60);
    assert!(desk.query_by_label(LEFT).is_none());
    // The camera continues to fit while the ball flies on.
    go_to(&mut desk, 40.0);
    desk.run_steps(60);
    assert!(desk.query_by_label(LEFT).is_none());
    press(&mut desk, Key::P);
    for _ in 0..60 {
        desk.run_steps(1);
        assert!(desk.query_by_label(LEFT).is_none(), "at {} s", scene(&desk).view().time);
    }
    press(&mut desk, Key::P);
    press(&mut desk, Key::Num0);
    go_to(&mut desk, 60.0);
    desk.run_steps(3);
    desk.get_by_label(LEFT);
}

#[test]
fn nothing_runs_behind_the_chooser_and_the_scene_goes_on_after_it() {
    let mut desk = choosing(setup());
    desk.get_by_label("Choose a scene");
    let frame = scene(&desk).view().frame;
    desk.run_steps(10);
    assert_eq!(scene(&desk).view().frame, frame);
    press(&mut desk, Key::Escape);
    assert!(desk.query_by_label("Choose a scene").is_none());
    desk.run_steps(4);
    let view = scene(&desk).view();
    assert!(view.playback.playing && view.frame > 0, "{}", view.frame);
    press(&mut desk, Key::Enter);
    let frame = scene(&desk).view().frame;
    desk.run_steps(10);
    assert_eq!(scene(&desk).view().frame, frame);
    // A scene that was paused stays paused.
    press(&mut desk, Key::Escape);
    press(&mut desk, Key::P);
    press(&mut desk, Key::Enter);
    press(&mut desk, Key::Escape);
    assert!(!scene(&desk).view().playback.playing);
}

#[test]
fn a_fitting_camera_shows_the_surfaces_of_a_scene_whose_balls_have_left() {
    let mut desk = watching("tutorial4");
    press(&mut desk, Key::Num0);
    go_to(&mut desk, 40.0);
    desk.run_steps(60);
    let camera = scene(&desk).camera().expect("a camera");
    // The large ball is at the origin.
    let place = camera.place(carom::DVec3::ZERO, 1.25).expect("it is before the camera");
    assert!(place.abs().max_element() < 0.9, "{place}");
    assert!(camera.position.length() < 100.0, "{camera:?}");
}
