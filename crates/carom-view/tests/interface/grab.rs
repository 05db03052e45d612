//! The picked ball is dragged by the pointer and thrown, and the run can be repeated.

use carom_scene::{Scene, Source};
use carom_session::Command;
use carom_view::{Setup, Start};
use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, PointerButton, Pos2, Rect, Vec2};
use egui_kittest::kittest::Queryable;

use crate::desk::{Desk, go_to, press, quick_desk, scene, setup};

/// A ball at rest in empty space, in units of this length.
fn resting(unit: f64) -> Desk {
    let text = format!(
        "name = \"resting\"\n[simulation]\nrule = \"exact\"\nframe_time = 0.02\n\
         [[spheres]]\nradius = {}\n[[spheres]]\nradius = {}\nposition = [0, {}, 0]\n\
         [camera]\nposition = [0, 0, {}]\nlook_at = [0, 0, 0]\nnear = {}\nfar = {}\n",
        0.5 * unit,
        0.5 * unit,
        4.0 * unit,
        12.0 * unit,
        0.01 * unit,
        1000.0 * unit,
    );
    let scene = Scene::from_toml(&text, "resting.toml").expect("a scene");
    let start = Some(Start::Scene(Box::new(scene), Source::Registered));
    let mut desk = quick_desk(Setup { start, ..setup() });
    let first = crate::desk::scene(&desk).view().spheres.ids[0];
    desk.state_mut().command(Command::Pick(Some(first)));
    desk.run_steps(3);
    desk
}

fn picture(desk: &Desk) -> Rect {
    desk.get_by_role_and_label(Role::Image, "Scene").rect()
}

fn button(desk: &mut Desk, pos: Pos2, pressed: bool) {
    let (button, modifiers) = (PointerButton::Primary, Modifiers::NONE);
    desk.event(Event::PointerButton { pos, button, pressed, modifiers });
    desk.run_steps(1);
}

/// Drags from a place by steps of 8 points to the right; returns where the pointer is.
fn drag(desk: &mut Desk, from: Pos2, steps: usize) -> Pos2 {
    desk.event(Event::PointerMoved(from));
    desk.run_steps(2);
    button(desk, from, true);
    let mut place = from;
    for _ in 0..steps {
        place += Vec2::new(8.0, 0.0);
        desk.event(Event::PointerMoved(place));
        desk.run_steps(1);
    }
    place
}

fn ball(desk: &Desk) -> Pos2 {
    desk.state().place_of(0, picture(desk)).expect("in view")
}

#[test]
fn a_dragged_ball_follows_on_a_spring_and_flies_on_when_let_go_at_any_size() {
    for unit in [1e-6, 1.0, 1e6] {
        let mut desk = resting(unit);
        press(&mut desk, Key::P);
        let camera = scene(&desk).camera();
        let from = ball(&desk);
        let pointer = drag(&mut desk, from, 24);
        assert_eq!(scene(&desk).view().springs.len(), 1, "{unit}");
        assert_eq!(scene(&desk).camera(), camera, "the camera stays");
        let place = scene(&desk).view().spheres.positions[0];
        assert!(place.x > 0.3 * unit && place.y.abs() < 0.05 * unit, "{unit}: {place}");
        button(&mut desk, pointer, false);
        desk.run_steps(3);
        let view = scene(&desk).view();
        assert_eq!(view.springs.len(), 0);
        let velocity = view.spheres.velocities[0];
        assert!(velocity.x > 0.3 * unit, "{unit}: {velocity}");
        assert_eq!(view.spheres.velocities[1].length(), 0.0);
    }
}

#[test]
fn a_throw_by_hand_is_computed_again_to_the_bit_and_undone_as_one() {
    let mut desk = resting(1.0);
    press(&mut desk, Key::P);
    desk.run_steps(5);
    let from = ball(&desk);
    let pointer = drag(&mut desk, from, 12);
    button(&mut desk, pointer, false);
    desk.run_steps(10);
    press(&mut desk, Key::P);
    let (time, before) = {
        let view = scene(&desk).view();
        (view.time, view.spheres.clone())
    };
    assert!(before.velocities[0].x > 0.0);
    go_to(&mut desk, 0.0);
    assert_eq!(scene(&desk).view().spheres.velocities[0].length(), 0.0);
    go_to(&mut desk, time);
    let again = &scene(&desk).view().spheres;
    assert_eq!((&again.positions, &again.velocities), (&before.positions, &before.velocities));
    desk.state_mut().command(Command::Undo);
    desk.run_steps(3);
    let view = scene(&desk).view();
    assert_eq!((view.undoable, view.springs.len()), (0, 0));
    assert_eq!(view.spheres.velocities[0].length(), 0.0);
}

#[test]
fn a_paused_ball_moves_with_the_pointer_and_back_by_undo() {
    let mut desk = resting(1.0);
    let from = ball(&desk);
    let pointer = drag(&mut desk, from, 10);
    button(&mut desk, pointer, false);
    desk.run_steps(3);
    let view = scene(&desk).view();
    assert!(view.spheres.positions[0].x > 0.5, "{}", view.spheres.positions[0]);
    assert_eq!((view.frame, view.springs.len(), view.undoable), (0, 0, 1));
    // It lies where the pointer is, up to what a drag needs to begin.
    assert!(ball(&desk).distance(pointer) < 16.0, "{} {pointer}", ball(&desk));
    desk.state_mut().command(Command::Undo);
    desk.run_steps(3);
    assert_eq!(scene(&desk).view().spheres.positions[0].length(), 0.0);
}

#[test]
fn a_drag_beside_the_picked_ball_turns_the_camera() {
    let mut desk = resting(1.0);
    press(&mut desk, Key::P);
    let camera = scene(&desk).camera();
    let from = ball(&desk) + Vec2::new(0.0, 120.0);
    let pointer = drag(&mut desk, from, 6);
    button(&mut desk, pointer, false);
    let view = scene(&desk).view();
    assert_eq!((view.springs.len(), view.undoable), (0, 0));
    assert_ne!(scene(&desk).camera(), camera);
}
