//! Edits appear on the time line, can be undone and redone, and are kept on a restart.

use carom_session::{Command, Edit};
use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;

use crate::desk::{Desk, go_to, press, scene, watching};

fn restitution(desk: &Desk) -> f64 {
    scene(desk).view().setup.colliders[0].1.restitution
}

/// Changes the restitution of all surfaces.
fn edit(desk: &mut Desk, restitution: f64) {
    desk.state_mut().command(Command::Edit(Edit::AllColliderRestitutions(restitution)));
    desk.run_steps(3);
}

fn press_with(desk: &mut Desk, modifiers: Modifiers, key: Key) {
    desk.key_press_modifiers(modifiers, key);
    desk.run_steps(4);
}

#[test]
fn an_edit_is_taken_back_and_made_again_by_keys_and_buttons() {
    let mut desk = watching("simtest1");
    let before = restitution(&desk);
    go_to(&mut desk, 1.0);
    edit(&mut desk, 0.05);
    go_to(&mut desk, 2.0);
    press_with(&mut desk, Modifiers::COMMAND, Key::Z);
    assert_eq!((restitution(&desk), scene(&desk).view().frame), (before, 50));
    press_with(&mut desk, Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    assert_eq!(restitution(&desk), 0.05);
    desk.get_by_label("Undo").click();
    desk.run_steps(4);
    assert_eq!(restitution(&desk), before);
    desk.get_by_label("Redo").click();
    desk.run_steps(4);
    assert_eq!(restitution(&desk), 0.05);
}

#[test]
fn a_restart_says_that_edits_come_again_and_offers_to_begin_with_their_values() {
    let mut desk = watching("simtest1");
    let before = restitution(&desk);
    go_to(&mut desk, 1.0);
    edit(&mut desk, 0.05);
    press(&mut desk, Key::Home);
    assert_eq!((restitution(&desk), scene(&desk).view().frame), (before, 0));
    desk.get_by_label_contains("Edits will come again");
    desk.get_by_label("Begin with their values").click();
    desk.run_steps(4);
    assert_eq!((restitution(&desk), scene(&desk).view().frame), (0.05, 0));
    desk.get_by_label_contains("begins with the values");
    press_with(&mut desk, Modifiers::COMMAND, Key::Z);
    assert_eq!(restitution(&desk), before);
    go_to(&mut desk, 1.5);
    assert_eq!(restitution(&desk), 0.05, "the edit is at its time again");
    press_with(&mut desk, Modifiers::SHIFT, Key::Home);
    assert_eq!((restitution(&desk), scene(&desk).view().frame), (0.05, 0));
}

#[test]
fn a_restart_without_edits_says_nothing_of_them() {
    let mut desk = watching("simtest1");
    go_to(&mut desk, 1.0);
    press(&mut desk, Key::Home);
    assert!(desk.query_by_label_contains("come again").is_none());
    desk.get_by_label("Play");
}
