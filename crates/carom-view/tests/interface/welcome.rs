//! The first visit: a scene plays, a line tells what can be done, and the others lie below it.

use carom_view::Setup;
use egui::accesskit::Role;
use egui::{Key, Theme};
use egui_kittest::SnapshotResults;
use egui_kittest::kittest::Queryable;

use crate::desk::{
    Desk, PlainHost, desk, desk_for_picture, desk_of, go_to, press, scene, setup,
    setup_for_pictures,
};
use crate::pictures::{compare, in_light_and_dark, set_theme};

const LINE: &str = "Drag to look. Click a ball. Ctrl-click throws one.";
const CLOSE: &str = "Close the list of scenes";

#[test]
fn a_scene_plays_at_full_width_under_one_line_that_tells_what_to_do() {
    let desk = desk(setup());
    desk.get_by_label(LINE);
    let view = scene(&desk).view();
    assert!(view.playback.playing && view.frame > 0, "{}", view.frame);
    let picture = desk.get_by_role_and_label(Role::Image, "Scene").rect();
    assert_eq!(picture.width(), 1000.0);
    assert!(picture.height() > 0.6 * 620.0, "{picture}");
    assert!(desk.query_by_label("Choose a scene").is_none());
}

#[test]
fn a_scene_of_the_strip_is_opened_by_a_click_and_plays() {
    let mut desk = desk(setup());
    desk.get_by_role_and_label(Role::Button, "Pour").click();
    desk.run_steps(6);
    let view = scene(&desk).view();
    assert_eq!(view.scene.name, "pour");
    assert!(view.playback.playing && view.frame > 0, "{}", view.frame);
    assert!(desk.query_by_label(LINE).is_none());
    assert!(desk.query_by_label(CLOSE).is_none());
}

#[test]
fn the_strip_closes_and_the_scene_goes_on() {
    for is_by_key in [true, false] {
        let mut desk = desk(setup());
        if is_by_key {
            press(&mut desk, Key::Escape);
        } else {
            desk.get_by_label(CLOSE).click();
            desk.run_steps(3);
        }
        assert!(desk.query_by_label(CLOSE).is_none());
        assert!(desk.query_by_label(LINE).is_none());
        assert!(scene(&desk).view().playback.playing);
    }
}

#[test]
fn settings_take_the_place_of_the_strip() {
    let mut desk = desk(setup());
    assert!(desk.query_by_label("Surfaces").is_none());
    press(&mut desk, Key::I);
    desk.get_by_label("Surfaces");
    assert!(desk.query_by_label(CLOSE).is_none());
}

#[test]
fn the_strip_is_used_by_keyboard_alone() {
    let mut desk = desk(setup());
    let has_second = |desk: &Desk| desk.get_by_role_and_label(Role::Button, "Pour").is_focused();
    let mut presses = 0;
    while !has_second(&desk) {
        press(&mut desk, Key::Tab);
        presses += 1;
        assert!(presses < 60, "Tab does not reach the strip");
    }
    press(&mut desk, Key::Enter);
    desk.run_steps(3);
    assert_eq!(scene(&desk).view().scene.name, "pour");
}

#[test]
fn nothing_moves_by_itself_for_users_who_want_little_motion() {
    let mut desk = desk(Setup {
        host: Box::new(PlainHost { reduces_motion: true, ..PlainHost::default() }),
        ..setup()
    });
    desk.run_steps(10);
    assert_eq!(scene(&desk).view().frame, 0);
    desk.get_by_label(CLOSE);
}

#[test]
fn the_line_and_the_buttons_are_within_small_windows() {
    for size in [[1280.0, 800.0], [390.0, 844.0], [844.0, 390.0]] {
        let desk = desk_of(size, setup());
        for label in [LINE, CLOSE, "All scenes"] {
            let rect = desk.get_by_label(label).rect();
            let is_within = rect.left() >= 0.0 && rect.right() <= size[0];
            assert!(is_within && rect.top() >= 0.0 && rect.bottom() <= size[1], "{label}: {rect}");
        }
        let picture = desk.get_by_role_and_label(Role::Image, "Scene").rect();
        assert!(picture.area() > 0.4 * size[0] * size[1], "{size:?}: {picture}");
    }
}

in_light_and_dark!(first_visits_of_three_sizes);

fn first_visits_of_three_sizes(theme: Theme) {
    let mut results = SnapshotResults::new();
    for [width, height] in [[1280.0, 800.0], [390.0, 844.0], [844.0, 390.0]] {
        let mut desk = desk_for_picture([width, height], 0.4, setup_for_pictures());
        set_theme(&mut desk, theme);
        press(&mut desk, Key::P);
        go_to(&mut desk, 1.5);
        // Until the pictures of the strip are drawn.
        desk.run_steps(80);
        let name = if theme == Theme::Dark { "dark" } else { "light" };
        compare(&mut desk, &format!("first_{width}_{name}"), &mut results);
    }
    results.unwrap();
}
