//! Hints over the picture: how to begin, the progress of a seek, where the balls are.

use carom_scene::Source;
use carom_scene::scene::{Scene, Sphere};
use carom_session::Command;
use carom_view::{Setup, Start};
use egui::Key;
use egui_kittest::kittest::Queryable;

use crate::desk::{Desk, desk, go_to, press, scene, setup, watching};

const LEFT: &str = "All balls have left the picture.";

/// Opens a scene with one ball that flies to the right, sixty radii a second.
fn flying() -> Desk {
    let mut flying = Scene::new("flying");
    let velocity = [30.0, 0.0, 0.0];
    flying.spheres.push(Sphere { velocity, ..Sphere::at([0.0; 3], 0.5) });
    desk(Setup { start: Some(Start::Scene(Box::new(flying), Source::Registered)), ..setup() })
}

#[test]
fn a_large_button_plays_a_scene_that_stands_at_its_start() {
    let mut desk = watching("simtest1");
    desk.get_by_label("Play the scene").click();
    desk.run_steps(10);
    assert!(scene(&desk).view().playback.playing && scene(&desk).view().frame > 0);
    assert!(desk.query_by_label("Play the scene").is_none());
    press(&mut desk, Key::P);
    assert!(desk.query_by_label("Play the scene").is_none());
}

#[test]
fn escape_ends_the_way_to_another_time_where_it_has_come_to() {
    let mut desk = watching("tutorial4");
    desk.state_mut().command(Command::Seek(1e5));
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
    let mut desk = watching("tutorial4");
    desk.state_mut().command(Command::Seek(1e5));
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
fn a_scene_plays_behind_the_chooser() {
    let mut desk = desk(setup());
    desk.get_by_label("Choose a scene");
    desk.run_steps(10);
    press(&mut desk, Key::Escape);
    assert!(desk.query_by_label("Choose a scene").is_none());
    let view = scene(&desk).view();
    assert!(view.playback.playing && view.frame > 0, "{}", view.frame);
}
