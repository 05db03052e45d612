//! The bar above the picture, the help, and what the pointer shows over settings.

use carom_scene::Library;
use carom_session::Command;
use egui::accesskit::Role;
use egui::{Key, Pos2, Rect};
use egui_kittest::kittest::{By, NodeT, Queryable};

use crate::desk::{Desk, PlainHost, desk, press, scene, setup, start, watching, watching_at};
use carom_view::{Group, Setup};

const WINDOW: [f32; 2] = [1280.0, 800.0];

/// Returns the names of the buttons above the picture, and their rectangles.
fn buttons(desk: &Desk) -> Vec<(String, Rect)> {
    let top = desk.get_by_role_and_label(Role::Image, "Scene").rect().top();
    let all = desk.query_all_by_role(Role::Button);
    let above = all.filter(|it| it.rect().bottom() <= top);
    above.map(|it| (it.accesskit_node().label().unwrap_or_default(), it.rect())).collect()
}

#[test]
fn the_bar_has_four_menus_and_the_settings_whose_words_differ() {
    let mut desk = watching_at(WINDOW, "cradle");
    let names: Vec<String> = buttons(&desk).into_iter().map(|(name, _)| name).collect();
    assert_eq!(names, ["Scenes", "View", "Measure", "Share", "Settings"]);
    desk.get_by_label("View").click();
    desk.run_steps(3);
    // "Scene" would be taken for "Scenes".
    assert!(desk.query_by_role_and_label(Role::Button, "Scene").is_none());
    for entry in ["Front", "Top", "Fit all", "Light or dark", "Keys"] {
        desk.get_by_label(entry);
    }
}

#[test]
fn on_a_telephone_the_bar_has_the_title_and_cuts_off_a_long_one() {
    let size = [390.0, 844.0];
    for (name, title) in
        [("billiards", "Billiards"), ("cradle-on-threads", "Newton's cradle on threads")]
    {
        let host = Box::new(PlainHost { has_coarse_pointer: true, ..PlainHost::default() });
        let desk = crate::desk::desk_of(size, Setup { start: start(name), host, ..setup() });
        let shown = desk.get_by_label(title).rect();
        let menu = desk.get_by_label("Menu").rect();
        assert!(shown.left() > menu.right() && shown.right() <= size[0], "{shown} {menu}");
        assert!((shown.center().y - menu.center().y).abs() <= 1.0, "{shown} {menu}");
    }
}

#[test]
fn the_help_has_groups_and_is_whole_in_a_window_of_1280_by_800() {
    let mut desk = watching_at(WINDOW, "cradle");
    press(&mut desk, Key::F1);
    desk.run_steps(3);
    for group in Group::ALL {
        desk.get_all_by_label(group.title()).last().expect("a heading");
    }
    let window = desk.get_by_role_and_label(Role::Window, "Keys and mouse").rect();
    for shortcut in carom_view::SHORTCUTS {
        let row = desk.get_by_label(shortcut.text).rect();
        assert!(window.contains_rect(row) && row.bottom() < WINDOW[1], "{}", shortcut.text);
    }
    // A key comes before the same key with Shift.
    let row = |keys: &str| desk.get_by_label(keys).rect().top();
    assert!(row("Home") < row("Shift + Home"));
}

/// Returns what the pointer shows at a place.
fn tooltip(desk: &mut Desk, place: Pos2) -> bool {
    desk.hover_at(place);
    // A tooltip comes after half a second.
    desk.run_steps(6);
    let found = desk.query_all(By::new().predicate(|it| it.role() == Role::Tooltip)).count() > 0;
    desk.hover_at(Pos2::new(400.0, 700.0));
    desk.run_steps(2);
    found
}

#[test]
fn every_value_of_the_settings_and_its_name_have_a_tooltip() {
    let mut desk = watching_at(WINDOW, "simtest1");
    crate::desk::go_to(&mut desk, 1.0);
    let ball = scene(&desk).view().spheres.ids[0];
    desk.state_mut().command(Command::Pick(Some(ball)));
    desk.run_steps(30);
    let picture = desk.get_by_role_and_label(Role::Image, "Scene").rect();
    let is_value = |role| matches!(role, Role::SpinButton | Role::Slider | Role::ComboBox);
    let found = desk.query_all(By::new().predicate(move |it| is_value(it.role())));
    let name = |it: &egui_kittest::Node<'_>| it.accesskit_node().label().unwrap_or_default();
    let values: Vec<(String, Rect)> = found.map(|it| (name(&it), it.rect())).collect();
    let is_seen = |rect: &Rect| rect.left() > picture.right() && rect.bottom() < picture.bottom();
    let values: Vec<_> = values.into_iter().filter(|(_, rect)| is_seen(rect)).collect();
    assert!(values.len() > 10, "{values:?}");
    for (name, rect) in values {
        assert!(tooltip(&mut desk, rect.center()), "none over {name} at {rect}");
    }
    for name in ["Radius", "Mass", "Drag coefficient", "One ball every (period)", "PlaneCollider"] {
        let place = desk.get_all_by_label(name).next().expect("a name").rect();
        let place = Pos2::new(place.left() + 4.0, place.center().y);
        assert!(tooltip(&mut desk, place), "none over {name}");
    }
}

#[test]
fn the_dialog_of_links_names_no_variable() {
    let mut desk = watching("cradle");
    press(&mut desk, Key::U);
    desk.run_steps(3);
    desk.get_by_label("Copy the link");
    let named = desk.query_all(By::new().predicate(|it| {
        let texts = [it.label(), it.value()];
        texts.iter().flatten().any(|text| text.contains('$') || text.contains("CAROM_"))
    }));
    assert_eq!(named.count(), 0);
}

#[test]
fn a_wheel_that_turns_on_and_on_loses_no_ball() {
    for name in ["bounce", "gas", "cradle"] {
        let mut desk = desk(Setup { start: start(name), ..setup() });
        let picture = desk.get_by_role_and_label(Role::Image, "Scene").rect();
        desk.hover_at(picture.center());
        for turn in 0..15 {
            desk.event(egui::Event::MouseWheel {
                unit: egui::MouseWheelUnit::Line,
                delta: egui::Vec2::new(0.0, 1.0),
                phase: egui::TouchPhase::Move,
                source: egui::MouseWheelSource::Unknown,
                modifiers: egui::Modifiers::NONE,
            });
            desk.run_steps(4);
            let balls = scene(&desk).view().spheres.ids.len();
            let is_seen = |index: usize| {
                let place = desk.state().place_of(index, picture);
                place.is_some_and(|it| picture.contains(it))
            };
            assert!((0..balls).any(is_seen), "{name}: after {turn} turns");
        }
    }
}

#[test]
fn every_scene_has_a_title_in_the_bar() {
    for entry in Library::new().entries().expect("built-in scenes") {
        let desk = watching_at(WINDOW, &entry.name);
        if desk.state().watching().is_some() {
            let title = scene(&desk).view().scene.title.clone();
            assert!(!title.is_empty() && desk.query_all_by_label(&title).count() > 0, "{title}");
        }
    }
}
