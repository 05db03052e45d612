//! Manual edits are undone and repeated bit for bit.

use carom::{DVec3, Sphere};
use carom_scene::scene::{Force, Rule};
use carom_session::{Command, Comparison, Driver, Edit, Session, SphereChange, View};

use crate::{busy, busy_scene, hashes};

fn moon() -> Edit {
    Edit::AddForce(Force::Gravity { acceleration: [0.0, 3.0, 0.0] })
}

fn thrown() -> Edit {
    let sphere = Sphere::new(DVec3::new(0.0, 5.0, 2.0), 0.2);
    Edit::Throw { sphere: Box::new(sphere), color: None }
}

fn take(session: &mut Session, frames: u64) {
    hashes(session, frames);
}

/// Goes to the frame to which the session is going.
fn arrive(session: &mut Session) {
    session.advance_seek(u64::MAX).unwrap();
}

#[test]
fn an_edit_taken_back_leaves_the_run_as_it_was_without_it() {
    let mut plain = busy();
    take(&mut plain, 40);
    let expected = hashes(&mut plain, 30);
    for edit in [moon(), thrown(), Edit::FrameTime(0.003), Edit::AllColliderRestitutions(0.1)] {
        let mut session = busy();
        take(&mut session, 40);
        session.edit(edit.clone()).unwrap();
        take(&mut session, 25);
        assert!(session.undo());
        arrive(&mut session);
        assert_eq!((session.frame(), session.furthest_frame()), (40, 40), "{edit:?}");
        assert!(session.changes().is_empty());
        assert_eq!(hashes(&mut session, 30), expected, "{edit:?}");
        assert!(!session.undo(), "nothing is left to take back");
    }
}

#[test]
fn an_edit_made_again_gives_the_run_with_it() {
    let mut session = busy();
    take(&mut session, 20);
    session.edit(Edit::FrameTime(0.004)).unwrap();
    session.edit(thrown()).unwrap();
    let expected = hashes(&mut session, 30);
    assert!(session.undo() && session.undo() && session.redo() && session.redo());
    arrive(&mut session);
    assert_eq!(hashes(&mut session, 30), expected);
    assert!(!session.redo());
    let time = session.time();
    assert_eq!(session.frame_at(time).unwrap(), 50, "frames have their length again");
}

#[test]
fn changes_that_an_edit_in_the_past_cut_off_come_back_with_it_taken_back() {
    let mut session = busy();
    take(&mut session, 30);
    session.edit(moon()).unwrap();
    take(&mut session, 20);
    let expected = session.state_hash();
    session.jump(0.1).unwrap();
    session.edit(thrown()).unwrap();
    assert_eq!(session.changes().len(), 1);
    session.undo();
    arrive(&mut session);
    assert_eq!(session.changes().len(), 1);
    session.seek(50);
    arrive(&mut session);
    assert_eq!(session.state_hash(), expected);
}

#[test]
fn what_is_done_anew_cannot_be_redone_over() {
    let mut session = busy();
    session.edit(moon()).unwrap();
    session.undo();
    session.edit(thrown()).unwrap();
    assert!(!session.redo());
    assert_eq!(session.changes().len(), 1);
}

#[test]
fn a_past_with_few_moments_is_undone_to_the_bit_as_well() {
    let mut plain = busy();
    take(&mut plain, 60);
    let expected = plain.state_hash();
    let mut session = busy();
    session.set_memory(0);
    take(&mut session, 50);
    session.edit(moon()).unwrap();
    take(&mut session, 20);
    session.undo();
    assert_eq!(session.seeking(), Some(50), "the way has to be gone again");
    arrive(&mut session);
    take(&mut session, 10);
    assert_eq!(session.state_hash(), expected);
}

#[test]
fn an_edit_that_goes_on_with_another_is_taken_back_with_it() {
    let mut session = busy();
    let before = session.setup().clone();
    session.edit(Edit::AllColliderRestitutions(0.5)).unwrap();
    take(&mut session, 3);
    session.edit_further(Edit::AllColliderRestitutions(0.4)).unwrap();
    assert!(session.undo());
    assert_eq!((session.frame(), session.setup()), (0, &before));
}

#[test]
fn a_refused_edit_leaves_nothing_to_take_back() {
    let mut session = busy();
    session.edit(moon()).unwrap();
    session.undo();
    assert!(session.edit(Edit::FrameTime(-1.0)).is_err());
    assert!(session.redo(), "what was taken back is still there");
}

#[test]
fn a_restart_with_values_is_a_run_that_began_with_them() {
    let mut session = busy();
    let ball = session.world().spheres().ids()[0];
    let moved = SphereChange {
        position: Some(DVec3::new(0.0, 9.0, 0.0)),
        mass: Some(7.0),
        ..SphereChange::default()
    };
    take(&mut session, 10);
    session.edit(Edit::AllColliderRestitutions(0.9)).unwrap();
    take(&mut session, 10);
    session.edit(Edit::AllColliderRestitutions(0.3)).unwrap();
    session.edit(Edit::Sphere(ball, Box::new(moved))).unwrap();
    session.edit(thrown()).unwrap();
    session.edit(moon()).unwrap();
    let there = session.state_hash();
    session.restart_with_values();
    assert_eq!(session.frame(), 0);

    let mut other = busy();
    other.edit(Edit::AllColliderRestitutions(0.3)).unwrap();
    let mass = SphereChange { mass: Some(7.0), ..SphereChange::default() };
    other.edit(Edit::Sphere(ball, Box::new(mass))).unwrap();
    other.edit(moon()).unwrap();
    assert_eq!(session.changes(), other.changes());
    assert_eq!(hashes(&mut session, 30), hashes(&mut other, 30));

    session.undo();
    arrive(&mut session);
    assert_eq!((session.frame(), session.state_hash()), (20, there));
}

#[test]
fn a_restart_with_values_keeps_what_was_put_there_at_the_start() {
    let mut session = busy();
    session.edit(thrown()).unwrap();
    let expected = session.state_hash();
    take(&mut session, 10);
    session.edit(thrown()).unwrap();
    session.restart_with_values();
    assert_eq!(session.state_hash(), expected);
}

#[test]
fn both_sessions_of_a_comparison_take_an_edit_back() {
    let mut comparison = Comparison::new(&busy_scene(), [Rule::Exact, Rule::Discrete]).unwrap();
    let steps = |it: &mut Comparison| (0..20).for_each(|_| it.step().unwrap());
    steps(&mut comparison);
    let expected = [comparison.first().state_hash(), comparison.second().state_hash()];
    comparison.edit(&moon()).unwrap();
    steps(&mut comparison);
    assert!(comparison.undo());
    comparison.advance_seek(u64::MAX).unwrap();
    assert_eq!([comparison.first().state_hash(), comparison.second().state_hash()], expected);
    let times: Vec<f64> = comparison.distances().map(|it| it.time).collect();
    assert!(times.is_sorted_by(|a, b| a < b) && times.len() == 21, "{times:?}");
}

#[test]
fn a_view_says_when_edits_come_and_what_can_be_taken_back() {
    let mut session = busy();
    take(&mut session, 10);
    let time = session.time();
    session.edit(Edit::FrameTime(0.005)).unwrap();
    take(&mut session, 10);
    session.edit(moon()).unwrap();
    session.restart().unwrap();
    let mut view = View::default();
    session.fill(&mut view);
    assert_eq!((view.undoable, view.redoable), (2, 0));
    assert!((view.edits[0] - time).abs() < 1e-12 && (view.edits[1] - time - 0.05).abs() < 1e-12);
    session.undo();
    session.fill(&mut view);
    assert_eq!((view.undoable, view.redoable, view.edits.len()), (1, 1, 1));
}

#[test]
fn edits_of_one_gesture_are_taken_back_together_and_those_apart_one_by_one() {
    let mut driver = Driver::inline(busy());
    let restitution = |driver: &Driver| driver.view().setup.colliders[0].1.restitution;
    let first = restitution(&driver);
    for (value, seconds_after) in [(0.7, 0.1), (0.6, 0.1), (0.5, 3.0), (0.2, 0.1)] {
        driver.send(Command::Edit(Edit::AllColliderRestitutions(value))).unwrap();
        driver.update(0.0, || false);
        driver.update(seconds_after, || false);
    }
    for expected in [0.5, first, first] {
        driver.send(Command::Undo).unwrap();
        driver.update(0.0, || false);
        assert_eq!(restitution(&driver), expected);
    }
    driver.send(Command::Redo).unwrap();
    driver.send(Command::Redo).unwrap();
    driver.update(0.0, || false);
    assert_eq!(restitution(&driver), 0.2);
}

#[test]
fn a_refused_edit_is_no_part_of_a_gesture() {
    let mut driver = Driver::inline(busy());
    let mut send = |command| {
        driver.send(command).unwrap();
        driver.update(0.0, || false);
        (driver.view().undoable, driver.view().setup.forces.len())
    };
    let forces = 2;
    assert_eq!(send(Command::Edit(moon())), (1, forces + 1));
    assert_eq!(send(Command::Edit(Edit::FrameTime(-1.0))), (1, forces + 1));
    assert_eq!(send(Command::Edit(Edit::FrameTime(0.01))), (2, forces + 1));
    assert_eq!(send(Command::Undo), (1, forces + 1), "the force stays");
}
