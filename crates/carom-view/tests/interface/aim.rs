//! A drag from the cue ball aims, and letting go strikes.

use carom::{DVec3, SphereId};
use carom_session::{Aim, Command};
use carom_view::Setup;
use egui::accesskit::Role;
use egui::{Event, Modifiers, PointerButton, Pos2, Rect, Vec2};
use egui_kittest::kittest::Queryable;

use crate::desk::{Desk, quick_desk, scene, setup, start};

fn table() -> Desk {
    let mut desk = quick_desk(Setup { start: start("nine-ball"), ..setup() });
    desk.state_mut().command(Command::Pause);
    desk.state_mut().command(Command::Restart);
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

fn cue_ball(desk: &Desk) -> SphereId {
    scene(desk).view().spheres.ids[0]
}

/// Drags from the cue ball by `way` in ten steps; returns where the pointer is.
fn drag(desk: &mut Desk, way: Vec2) -> Pos2 {
    let from = desk.state().place_of(0, picture(desk)).expect("in view");
    desk.event(Event::PointerMoved(from));
    desk.run_steps(1);
    button(desk, from, true);
    for i in 1..=10 {
        desk.event(Event::PointerMoved(from + way * (0.1 * i as f32)));
        desk.run_steps(1);
    }
    desk.run_steps(2);
    from + way
}

#[test]
fn the_path_of_the_aimed_ball_is_what_then_happens() {
    let mut desk = table();
    let (camera, id) = (scene(&desk).camera(), cue_ball(&desk));
    let pointer = drag(&mut desk, Vec2::new(50.0, -110.0));
    assert_eq!(scene(&desk).camera(), camera, "the camera stays");
    let path = scene(&desk).view().aimed.clone();
    assert!(path.len() > 20, "{}", path.len());
    button(&mut desk, pointer, false);
    desk.run_steps(2);
    let view = scene(&desk).view();
    assert!(view.aimed.is_empty() && view.playback.playing);
    desk.state_mut().command(Command::Pause);
    desk.state_mut().command(Command::Restart);
    desk.run_steps(2);
    // The run from the start has the blow as an edit.
    let aim = aimed(&desk, id);
    assert!(aim.velocity.length() > 1.0 && aim.velocity.y == 0.0, "{}", aim.velocity);
    // Three frames are two intervals of the points of the path.
    for frames in [3, 6, 9] {
        let time = f64::from(frames) / 60.0;
        desk.state_mut().command(Command::Seek(time));
        desk.run_steps(4);
        let place = scene(&desk).view().spheres.positions[0];
        let expected = path[(time * 40.0).round() as usize];
        assert!((place - expected).length() < 1e-12, "{frames}: {place} {expected}");
    }
}

/// Returns the ball with its velocity.
fn aimed(desk: &Desk, sphere: SphereId) -> Aim {
    let view = scene(desk).view();
    let index = view.spheres.index_of(sphere).expect("the cue ball");
    Aim { sphere, velocity: view.spheres.velocities[index] }
}

#[test]
fn letting_go_on_the_ball_strikes_nothing() {
    let mut desk = table();
    let before = aimed(&desk, cue_ball(&desk));
    let edits = scene(&desk).view().edits.len();
    drag(&mut desk, Vec2::new(60.0, 0.0));
    let from = desk.state().place_of(0, picture(&desk)).expect("in view");
    desk.event(Event::PointerMoved(from));
    desk.run_steps(2);
    assert!(scene(&desk).view().aimed.is_empty());
    button(&mut desk, from, false);
    desk.run_steps(2);
    assert_eq!(aimed(&desk, before.sphere), before);
    assert_eq!(scene(&desk).view().edits.len(), edits);
}

#[test]
fn a_longer_drag_strikes_harder_and_another_direction_elsewhere() {
    let velocity = |way: Vec2| {
        let mut desk = table();
        let pointer = drag(&mut desk, way);
        button(&mut desk, pointer, false);
        desk.state_mut().command(Command::Pause);
        desk.state_mut().command(Command::Restart);
        desk.run_steps(3);
        aimed(&desk, cue_ball(&desk)).velocity
    };
    let [short, long] = [30.0, 60.0].map(|way| velocity(Vec2::new(way, 0.0)));
    assert!(long.length() > 1.5 * short.length(), "{short} {long}");
    assert!(long.normalize().dot(short.normalize()) > 0.99, "{short} {long}");
    let left = velocity(Vec2::new(-60.0, 0.0));
    assert!(left.dot(long) < 0.0, "{left} {long}");
    assert_eq!(DVec3::new(left.x, 0.0, left.z), left);
}
