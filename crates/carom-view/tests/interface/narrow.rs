//! Windows as narrow as telephones.

use carom_scene::{Library, Source};
use carom_view::{Setup, Start};
use egui::accesskit::Role;
use egui_kittest::kittest::Queryable;

use crate::desk::{Desk, desk_of, setup};

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
