//! Windows as narrow as those of telephones.

use carom_scene::{Library, Source};
use carom_view::{FilmMaker, Host, Inbox, Setup, Start};
use egui::accesskit::Role;
use egui::{DroppedFileHandle, Key, Rect};
use egui_kittest::kittest::{By, Queryable};

use crate::desk::{Desk, desk_of, press, setup};

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

/// A telephone as its browser reports it.
struct Telephone;

impl Host for Telephone {
    fn save(&mut self, _: &str, _: &str, _: &[u8]) -> Result<String, String> {
        Err("it keeps nothing".to_owned())
    }

    fn read(&mut self, _: &DroppedFileHandle, _: &Inbox) {}

    fn open_file(&mut self, _: &Inbox) {}

    fn begin_film(&mut self, _: &str, _: [u32; 2], _: u32) -> Result<Box<dyn FilmMaker>, String> {
        Err("it makes no films".to_owned())
    }

    fn has_coarse_pointer(&self) -> bool {
        true
    }
}

#[test]
fn what_fingers_press_is_large_enough_for_them_and_the_picture_keeps_half() {
    let (scene, _) = Library::new().find("simtest3", &[]).expect("a built-in scene");
    let start = Some(Start::Scene(Box::new(scene), Source::BuiltIn));
    let mut desk = desk_of(TELEPHONE, Setup { start, host: Box::new(Telephone), ..setup() });
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
    let (scene, _) = Library::new().find("simtest3", &[]).expect("a built-in scene");
    let start = Some(Start::Scene(Box::new(scene), Source::BuiltIn));
    let mut desk = desk_of(TELEPHONE, Setup { start, host: Box::new(Telephone), ..setup() });
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
    for label in ["Inspector", "Plots", "Two rules", "Top", "Picture", "Film", "Link", "Keys"] {
        desk.get_by_label(label);
    }
    desk.get_by_label("Inspector").click();
    desk.run_steps(3);
    desk.get_by_label("rule");
}

#[test]
fn in_small_windows_the_picture_keeps_half_of_the_room_beside_two_panels() {
    for size in [[800.0, 600.0], [640.0, 640.0], [1000.0, 620.0]] {
        let (simtest, _) = Library::new().find("simtest3", &[]).expect("a built-in scene");
        let start = Some(Start::Scene(Box::new(simtest), Source::BuiltIn));
        let mut desk = desk_of(size, Setup { start, ..setup() });
        press(&mut desk, Key::G);
        // Both panels are open, over the picture if there is no space beside it.
        desk.get_by_label("rule");
        assert!(desk.query_by_label_contains("Energy, J").is_some(), "{size:?}");
        let picture = desk.get_by_role_and_label(Role::Image, "Scene").rect();
        assert!(picture.width() >= 0.49 * size[0], "{size:?}: {picture}");
        assert!(picture.height() >= 0.75 * size[1], "{size:?}: {picture}");
    }
}

#[test]
fn on_a_telephone_one_sheet_at_a_time_lies_over_the_foot_of_the_picture() {
    let mut desk = on_a_telephone();
    press(&mut desk, Key::I);
    let rule = desk.get_by_label("rule").rect();
    assert!(rule.top() > 0.5 * TELEPHONE[1] && rule.right() <= TELEPHONE[0], "{rule}");
    press(&mut desk, Key::G);
    assert!(desk.query_by_label("rule").is_none());
    let energy = desk.get_by_label_contains("Energy, J").rect();
    assert!(energy.top() > 0.5 * TELEPHONE[1], "{energy}");
}
