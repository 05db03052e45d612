//! Play, step, and go back in time.

use carom_session::Command;
use egui::{Event, Key, Modifiers, PointerButton};
use egui_kittest::kittest::Queryable;

use crate::desk::{go_to, press, scene, watching};

#[test]
fn it_plays_until_it_is_paused() {
    let mut desk = watching("simtest1");
    assert_eq!(scene(&desk).view().frame, 0);
    press(&mut desk, Key::P);
    desk.run_steps(30);
    let played = scene(&desk).view().frame;
    assert!(played > 5, "{played}");
    desk.get_by_label("Pause").click();
    desk.run_steps(3);
    let paused = scene(&desk).view().frame;
    desk.run_steps(20);
    assert_eq!(scene(&desk).view().frame, paused);
}

#[test]
fn a_press_that_lasts_and_does_not_move_is_a_click() {
    let mut desk = watching("simtest1");
    let pos = desk.get_by_label("Play").rect().center();
    desk.event(Event::PointerMoved(pos));
    for pressed in [true, false] {
        let (button, modifiers) = (PointerButton::Primary, Modifiers::NONE);
        desk.event(Event::PointerButton { pos, button, pressed, modifiers });
        // Steps of a quarter of a second.
        desk.run_steps(8);
    }
    assert!(scene(&desk).view().frame > 0);
}

#[test]
fn a_step_forward_and_one_back_give_the_same_bits() {
    let mut desk = watching("simtest1");
    desk.state_mut().command(Command::ShowStateHash(true));
    go_to(&mut desk, 2.0);
    let before = scene(&desk).view().playback.state_hash;
    press(&mut desk, Key::Period);
    let after = scene(&desk).view().playback.state_hash;
    assert_eq!(scene(&desk).view().frame, 101);
    assert_ne!(before, after);
    press(&mut desk, Key::Comma);
    assert_eq!(scene(&desk).view().frame, 100);
    assert_eq!(scene(&desk).view().playback.state_hash, before);
    desk.get_by_label("Step").click();
    desk.run_steps(3);
    assert_eq!(scene(&desk).view().playback.state_hash, after);
}

#[test]
fn restart_goes_back_to_the_start_and_keeps_the_future() {
    let mut desk = watching("simtest1");
    go_to(&mut desk, 2.0);
    press(&mut desk, Key::Home);
    assert_eq!(scene(&desk).view().frame, 0);
    assert_eq!(scene(&desk).view().furthest_frame, 100);
}

#[test]
fn speed_goes_from_a_fiftieth_to_ten_and_no_further() {
    let mut desk = watching("tutorial1");
    for _ in 0..12 {
        press(&mut desk, Key::Plus);
    }
    assert_eq!(scene(&desk).view().playback.speed, 10.0);
    for _ in 0..20 {
        press(&mut desk, Key::Minus);
    }
    assert_eq!(scene(&desk).view().playback.speed, 0.02);
}

#[test]
fn two_rules_run_side_by_side() {
    let mut desk = watching("simtest1");
    press(&mut desk, Key::X);
    go_to(&mut desk, 3.0);
    let view = scene(&desk).view();
    let other = view.other.as_ref().expect("there are two");
    assert_ne!(view.setup.simulation.rule, other.setup.simulation.rule);
    assert_eq!(view.frame, other.frame);
    let distance = view.distances.last().expect("it is measured");
    assert!(distance.largest > 0.0, "rules that find impacts differently come apart");
    press(&mut desk, Key::X);
    assert!(scene(&desk).view().other.is_none());
}
