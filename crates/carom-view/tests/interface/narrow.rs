//! Windows as narrow as those of telephones.

use carom_scene::{Library, Source};
use carom_session::Command;
use carom_view::{Setup, Start};
use egui::accesskit::Role;
use egui::{Key, Rect};
use egui_kittest::kittest::{By, Queryable};

use crate::desk::{Desk, PlainHost, desk_of, press, scene, setup, watching_at};

const TELEPHONE: [f32; 2] = [390.0, 760.0];

fn on_a_telephone() -> Desk {
    let (scene, _) = Library::new().find("simtest3", &[]).expect("a built-in scene");
    let start = Some(Start::Scene(Box::new(scene), Source::BuiltIn));
    desk_of(TELEPHONE, Setup { start, ..setup() })
}

#[test]
fn nothing_to_press_lies_outside_and_the_picture_has_most_of_the_room() {
    let desk = on_a_telephone();
    for label in ["Scenes", "Menu", "Restart", "Play", "Step", "Speed", "Time line"] {
        let rect = desk.get_by_label(label).rect();
        assert!(rect.left() >= 0.0 && rect.right() <= TELEPHONE[0], "{label}: {rect}");
    }
    let picture = desk.get_by_role_and_label(Role::Image, "Scene").rect();
    assert!(picture.area() > 0.8 * TELEPHONE[0] * TELEPHONE[1], "{picture}");
}

/// A scene in the small window of a telephone, which is used by fingers.
fn telephone() -> Desk {
    let (scene, _) = Library::new().find("simtest3", &[]).expect("a built-in scene");
    let start = Some(Start::Scene(Box::new(scene), Source::BuiltIn));
    desk_of(
        TELEPHONE,
        Setup {
            start,
            host: Box::new(PlainHost { has_coarse_pointer: true, ..PlainHost::default() }),
            ..setup()
        },
    )
}

#[test]
fn what_fingers_press_is_large_enough_for_them_and_the_picture_keeps_half() {
    let mut desk = telephone();
    let assert_large = |desk: &Desk, least: usize| {
        let all = desk.query_all(
            By::new()
                .predicate(|it| matches!(it.role(), Role::Button | Role::Slider | Role::CheckBox)),
        );
        let rects: Vec<Rect> = all.map(|it| it.rect()).collect();
        assert!(rects.len() >= least, "{rects:?}");
        for rect in rects {
            // Positions are rounded to pixels.
            let is_large = rect.width() >= 43.5 && rect.height() >= 43.5;
            assert!(is_large && rect.right() <= TELEPHONE[0], "{rect}");
        }
    };
    assert_large(&desk, 8);
    let picture = desk.get_by_role_and_label(Role::Image, "Scene").rect();
    assert!(picture.area() > 0.5 * TELEPHONE[0] * TELEPHONE[1], "{picture}");
    desk.get_by_label("Menu").click();
    desk.run_steps(3);
    assert_large(&desk, 20);
    press(&mut desk, Key::Escape);
    press(&mut desk, Key::Enter);
    desk.run_steps(24);
    // The list scrolls: cards may be cut off below, but none lies beside the window.
    for card in desk.query_all_by_role(Role::Button) {
        let rect = card.rect();
        assert!(rect.left() >= 0.0 && rect.right() <= TELEPHONE[0], "{rect}");
    }
    let heading = desk.get_by_label("Choose a scene").rect();
    assert!(heading.left() >= 0.0 && heading.top() >= 0.0, "{heading}");
}

#[test]
fn fingers_close_sheets_and_dialogs_and_these_stay_in_the_window() {
    let mut desk = telephone();
    for key in [Key::I, Key::G, Key::F1, Key::U] {
        press(&mut desk, key);
        desk.run_steps(3);
        let close = desk.get_by_label("Close window");
        let rect = close.rect();
        assert!(rect.width() >= 43.5 && rect.height() >= 43.5, "{key:?}: {rect}");
        assert!(rect.right() <= TELEPHONE[0] && rect.bottom() <= TELEPHONE[1], "{key:?}: {rect}");
        close.click();
        desk.run_steps(3);
        assert!(desk.query_by_label("Close window").is_none(), "{key:?}");
    }
}

#[test]
fn the_menu_has_what_the_bar_has_elsewhere() {
    let mut desk = on_a_telephone();
    assert!(desk.query_by_label("Plots").is_none());
    desk.get_by_label("Menu").click();
    desk.run_steps(3);
    for label in ["Settings", "Plots", "Two rules", "Top", "Picture", "Film", "Link", "Keys"] {
        desk.get_by_label(label);
    }
    desk.get_by_label("Settings").click();
    desk.run_steps(3);
    desk.get_by_role_and_label(Role::Window, "Settings");
}

#[test]
fn in_a_large_window_the_inspector_is_beside_the_picture_and_has_one_width() {
    let mut desk = watching_at([1280.0, 800.0], "gas");
    let right = |desk: &Desk| desk.get_by_role_and_label(Role::Image, "Scene").rect().right();
    let before = right(&desk);
    assert!((1280.0 - before - 300.0).abs() < 2.0, "{before}");
    // A picked ball fills it with numbers whose digits change.
    let ball = scene(&desk).view().spheres.ids[0];
    desk.state_mut().command(Command::Pick(Some(ball)));
    press(&mut desk, Key::P);
    for _ in 0..20 {
        desk.run_steps(1);
        assert_eq!(right(&desk), before);
    }
}

#[test]
fn below_nine_hundred_points_one_sheet_covers_two_fifths_of_the_picture_at_most() {
    for size in [[800.0, 600.0], [640.0, 640.0], TELEPHONE, [844.0, 390.0]] {
        let mut desk = watching_at(size, "simtest3");
        let picture = desk.get_by_role_and_label(Role::Image, "Scene").rect();
        assert!(picture.width() > 0.99 * size[0], "{size:?}: {picture}");
        let assert_covers_little = |desk: &Desk, label: &str| {
            let rect = desk.get_by_role_and_label(Role::Window, label).rect();
            let covered = rect.intersect(picture).area() / picture.area();
            // The frame of the sheet is a few points wide.
            assert!(covered > 0.3 && covered < 0.42, "{label} at {size:?}: {covered}");
            assert!(picture.contains_rect(rect), "{label} at {size:?}: {rect} {picture}");
        };
        press(&mut desk, Key::I);
        assert_covers_little(&desk, "Settings");
        press(&mut desk, Key::G);
        assert_covers_little(&desk, "Plots");
        assert!(desk.query_by_role_and_label(Role::Window, "Settings").is_none(), "{size:?}");
    }
}

#[test]
fn play_is_the_largest_control_and_stays_where_it_is() {
    for size in [[1280.0, 800.0], [800.0, 600.0], TELEPHONE, [844.0, 390.0]] {
        let mut desk = watching_at(size, "simtest1");
        let play = desk.get_by_label("Play").rect();
        for other in ["Restart", "Step back", "Step", "Undo", "Redo"] {
            let other = desk.get_by_label(other).rect();
            assert!(play.area() > 2.0 * other.area(), "{size:?}: {play} {other}");
        }
        let line = desk.get_by_label("Time line").rect().left();
        press(&mut desk, Key::P);
        assert_eq!(desk.get_by_label("Pause").rect(), play, "{size:?}");
        desk.state_mut().command(Command::ShowStateHash(true));
        press(&mut desk, Key::P);
        assert_eq!(desk.get_by_label("Play").rect(), play, "{size:?}");
        assert_eq!(desk.get_by_label("Time line").rect().left(), line, "{size:?}");
    }
}
