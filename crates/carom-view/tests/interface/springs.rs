//! Springs in the inspector: listed, changed, removed and added; each change can be undone.

use carom::{SphereId, Spring, SpringEnd};
use carom_session::Command;
use egui::{Key, Modifiers, Role, Theme};
use egui_kittest::SnapshotResults;
use egui_kittest::kittest::Queryable;

use crate::desk::{Desk, SIZE, press, scene, watching};
use crate::pictures::{compare, set_theme, watched};

fn springs(desk: &Desk) -> Vec<Spring> {
    scene(desk).view().springs.iter().map(|(_, spring)| *spring).collect()
}

/// Scrolls to a control with this label and clicks it.
fn click(desk: &mut Desk, label: &str) {
    let node = desk.get_by_label(label);
    node.scroll_to_me();
    desk.run_steps(30);
    desk.get_by_label(label).click();
    desk.run_steps(30);
}

/// Types a number into the field with this label.
fn type_into(desk: &mut Desk, label: &str, number: &str) {
    let node = desk.get_by_role_and_label(Role::SpinButton, label);
    node.scroll_to_me();
    desk.run_steps(30);
    desk.get_by_role_and_label(Role::SpinButton, label).click();
    desk.run_steps(2);
    desk.event(egui::Event::Text(number.to_owned()));
    desk.run_steps(2);
    press(desk, Key::Enter);
}

fn pick(desk: &mut Desk, ball: u64) {
    desk.state_mut().command(Command::Pick(Some(SphereId::from_number(ball))));
    desk.run_steps(4);
}

fn undo(desk: &mut Desk) {
    desk.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    desk.run_steps(4);
}

#[test]
fn a_spring_that_is_unfolded_changes_and_the_change_is_taken_back() {
    let mut desk = watching("spring-chain");
    let before = springs(&desk);
    click(&mut desk, "ball 0 to ball 1");
    type_into(&mut desk, "Rest length, m", "0.25");
    type_into(&mut desk, "Stiffness, N/m", "12.5");
    type_into(&mut desk, "Damping, kg/s", "0.75");
    desk.get_by_role_and_label(Role::CheckBox, "Only pulls").click();
    desk.run_steps(4);
    let after = springs(&desk);
    let spring =
        Spring { rest_length: 0.25, stiffness: 12.5, damping: 0.75, only_pulls: true, ..before[0] };
    assert_eq!((after[0], &after[1..]), (spring, &before[1..]));
    while scene(&desk).view().undoable > 0 {
        undo(&mut desk);
    }
    assert_eq!(springs(&desk), before);
}

#[test]
fn a_spring_that_is_removed_comes_back_on_undo() {
    let mut desk = watching("spring-chain");
    let before = springs(&desk);
    click(&mut desk, "ball 1 to ball 2");
    click(&mut desk, "Remove spring");
    let after = springs(&desk);
    assert_eq!((after[0], &after[1..]), (before[0], &before[2..]));
    assert!(desk.query_by_label("ball 1 to ball 2").is_none());
    undo(&mut desk);
    assert_eq!(springs(&desk), before);
}

#[test]
fn of_many_springs_those_at_the_picked_ball_are_listed() {
    let mut desk = watching("spring-chain");
    assert!(desk.query_by_label("ball 49 to ball 50").is_none());
    desk.get_by_label_contains("pick a ball for those at it");
    pick(&mut desk, 50);
    desk.get_by_label("ball 49 to ball 50");
    desk.get_by_label("ball 50 to ball 51");
    assert!(desk.query_by_label("ball 0 to ball 1").is_none());
}

#[test]
fn a_ball_is_joined_to_the_one_picked_before_and_to_a_place() {
    let mut desk = watching("simtest1");
    crate::desk::go_to(&mut desk, 2.0);
    let balls = &scene(&desk).view().spheres;
    let [one, other] = [balls.ids[0], balls.ids[1]];
    let apart = (balls.positions[0] - balls.positions[1]).length();
    let place = balls.positions[1];
    assert!(desk.query_by_label("+ spring to this place").is_none());
    pick(&mut desk, one.number());
    pick(&mut desk, other.number());
    click(&mut desk, &format!("+ spring to ball {one}"));
    click(&mut desk, "+ spring to this place");
    let added = springs(&desk);
    assert_eq!((added[0].sphere, added[0].to), (other, SpringEnd::Sphere(one)));
    // A new spring is at rest.
    assert_eq!(added[0].rest_length, apart);
    assert_eq!((added[1].sphere, added[1].to), (other, SpringEnd::Point(place)));
    assert!(added[0].stiffness > 0.0 && added[1].stiffness > 0.0);
    assert!(!desk.state().notices().any_error());
    undo(&mut desk);
    assert_eq!(springs(&desk), added[..1]);
}

#[test]
fn a_new_spring_swings_its_ball_and_comes_again_on_a_restart() {
    let mut desk = watching("simtest1");
    crate::desk::go_to(&mut desk, 2.0);
    let ball = scene(&desk).view().spheres.ids[0];
    pick(&mut desk, ball.number());
    click(&mut desk, "+ spring to this place");
    crate::desk::go_to(&mut desk, 2.5);
    let held = scene(&desk).view().spheres.clone();
    press(&mut desk, Key::Home);
    assert_eq!(springs(&desk), []);
    crate::desk::go_to(&mut desk, 2.5);
    assert_eq!(springs(&desk).len(), 1);
    assert_eq!(scene(&desk).view().spheres.positions, held.positions);
}

#[test]
fn the_inspector_of_springs() {
    let mut results = SnapshotResults::new();
    let mut desk = watched(SIZE, "cradle-on-threads");
    set_theme(&mut desk, Theme::Light);
    pick(&mut desk, 0);
    for section in ["Ball", "Forces"] {
        desk.get_by_label(section).click();
        desk.run_steps(30);
    }
    click(&mut desk, "ball 0 to (-0.4, 1, 0.3)");
    compare(&mut desk, "springs_light", &mut results);
    results.unwrap();
}
