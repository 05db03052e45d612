//! The past is restored bit for bit.

use carom::{DVec3, SphereId};
use carom_scene::scene::{Rule, Zones};
use carom_session::{Edit, Session, SessionError, SphereChange};

use crate::{built_in, busy, busy_scene, hashes};

fn first_sphere(session: &Session) -> SphereId {
    session.world().spheres().ids()[0]
}

fn push(session: &mut Session, velocity: DVec3) {
    let change = SphereChange { velocity: Some(velocity), ..SphereChange::default() };
    session.edit(Edit::Sphere(first_sphere(session), Box::new(change))).unwrap();
}

#[test]
fn step_back_returns_to_the_same_bits() {
    for rule in [Rule::Exact, Rule::Bisect, Rule::Discrete] {
        let mut scene = busy_scene();
        scene.simulation.rule = rule;
        let mut session = Session::new(scene).unwrap();
        let there = hashes(&mut session, 60);
        for frame in (0..60).rev() {
            session.step_back().unwrap();
            assert_eq!(session.frame(), frame as u64);
            assert_eq!(session.state_hash(), there[frame], "{rule:?}, frame {frame}");
        }
        assert_eq!(hashes(&mut session, 60), there, "{rule:?}, forward again");
    }
}

#[test]
fn there_is_nothing_before_the_beginning() {
    let mut session = busy();
    let start = session.state_hash();
    session.step_back().unwrap();
    assert_eq!((session.frame(), session.state_hash()), (0, start));
}

#[test]
fn a_jump_gives_the_bits_of_stepping() {
    let mut stepped = busy();
    let there = hashes(&mut stepped, 120);
    // To new frames, back, forth over known frames, and to a moment that is not stored.
    let mut session = busy();
    for frame in [100_u64, 3, 77, 78, 120, 119, 0, 50] {
        session.jump(frame as f64 / 60.0).unwrap();
        assert_eq!(session.frame(), frame);
        assert_eq!(session.state_hash(), there[frame as usize], "frame {frame}");
    }
    assert_eq!(session.furthest_frame(), 120);
    assert_eq!(session.furthest(), stepped.time());
}

#[test]
fn a_jump_in_small_pieces_gives_the_same_bits() {
    let mut stepped = busy();
    let there = hashes(&mut stepped, 50);
    let mut session = busy();
    session.seek(50);
    let mut pieces = 0;
    while !session.advance_seek(7).unwrap() {
        pieces += 1;
        assert_eq!(session.frame(), 7 * pieces);
        assert_eq!(session.seeking(), Some(50));
    }
    assert_eq!((pieces, session.state_hash()), (7, there[50]));
}

#[test]
fn a_time_that_makes_no_sense_is_refused() {
    let mut session = busy();
    for time in [-1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(session.jump(time), Err(SessionError::Time { .. })), "{time}");
    }
}

#[test]
fn an_edit_is_repeated_when_its_time_comes_again() {
    let mut session = busy();
    let mut there = hashes(&mut session, 20);
    // Two edits at one frame, and others with and without an effect on flights.
    push(&mut session, DVec3::new(3.0, 4.0, 0.0));
    session.edit(Edit::FrameTime(0.01)).unwrap();
    there[20] = session.state_hash();
    there.extend(hashes(&mut session, 20).drain(1..));
    let force = session.setup().forces[0].0;
    session.edit(Edit::RemoveForce(force)).unwrap();
    there.extend(hashes(&mut session, 20).drain(1..));
    let furthest = session.furthest();

    for frame in [59_u64, 40, 39, 21, 20, 19, 5, 45, 60, 10, 20] {
        session.seek(frame);
        session.advance_seek(u64::MAX).unwrap();
        assert_eq!(session.state_hash(), there[frame as usize], "frame {frame}");
        assert_eq!(session.frame_time(), if frame < 20 { 1.0 / 60.0 } else { 0.01 });
        assert_eq!(session.setup().forces.len(), if frame < 40 { 2 } else { 1 });
    }
    session.restart().unwrap();
    assert_eq!(hashes(&mut session, 60), there);
    assert_eq!(session.furthest(), furthest);
}

#[test]
fn times_lead_to_their_frames_where_frames_changed_their_length() {
    let mut session = busy();
    hashes(&mut session, 30);
    session.edit(Edit::FrameTime(0.1)).unwrap();
    hashes(&mut session, 10);
    for (time, frame) in [(0.25, 15), (0.5, 30), (0.6, 31), (1.5, 40), (2.0, 45), (0.0, 0)] {
        session.jump(time).unwrap();
        assert_eq!(session.frame(), frame, "{time} s");
        // The sum of frame times differs by this much from the product.
        assert!((session.time() - time).abs() < 1e-12, "{} s for {time} s", session.time());
    }
}

#[test]
fn a_new_edit_cuts_off_the_future() {
    let mut session = busy();
    let there = hashes(&mut session, 40);
    push(&mut session, DVec3::X);
    session.jump(10.0 / 60.0).unwrap();
    push(&mut session, DVec3::new(0.0, 9.0, 0.0));
    assert_eq!((session.furthest_frame(), session.furthest()), (10, session.time()));
    let other = hashes(&mut session, 40);
    assert!(other.iter().skip(1).zip(&there[11..]).all(|(one, other)| one != other));
    // The edit at frame 40, which was cut off, does not return.
    session.jump(0.0).unwrap();
    let again = hashes(&mut session, 50);
    assert_eq!(again[..10], there[..10]);
    assert_eq!(again[10..], other);
}

#[test]
fn a_refused_edit_changes_nothing_and_cuts_off_nothing() {
    let mut session = busy();
    let there = hashes(&mut session, 40);
    session.jump(20.0 / 60.0).unwrap();
    let (setup, force) = (session.setup().clone(), session.setup().forces[0].0);
    let bad = SphereChange { radius: Some(-1.0), ..SphereChange::default() };
    let id = first_sphere(&session);
    assert!(session.edit(Edit::Sphere(id, Box::new(bad))).is_err());
    assert!(session.edit(Edit::FrameTime(0.0)).is_err());
    assert!(session.edit(Edit::AllColliderRestitutions(1.5)).is_err());
    let mut other = busy();
    other.edit(Edit::RemoveForce(force)).unwrap();
    assert!(other.edit(Edit::RemoveForce(force)).is_err());
    assert_eq!((session.setup(), session.furthest_frame()), (&setup, 40));
    assert_eq!(hashes(&mut session, 20), there[20..]);
}

#[test]
fn a_step_that_failed_leaves_the_past_as_it_was_and_is_part_of_it() {
    let mut scene = busy_scene();
    scene.simulation.exact.max_impacts = 2;
    scene.simulation.exact.zones = Zones::Never;
    let mut session = Session::new(scene).unwrap();
    let mut there = vec![session.state_hash()];
    let error = loop {
        match session.step() {
            Ok(()) => there.push(session.state_hash()),
            Err(error) => break error,
        }
    };
    let frames = session.frame();
    assert!(matches!(error, SessionError::World(carom::Error::TooManyImpacts { .. })), "{error}");
    assert_eq!(session.state_hash(), there[frames as usize]);
    // With shorter frames it continues. All flights were computed again after the failure, and are
    // in the replay.
    session.edit(Edit::FrameTime(1e-4)).unwrap();
    there.extend(hashes(&mut session, 30).drain(1..));
    session.restart().unwrap();
    assert_eq!(hashes(&mut session, frames + 30), there);
}

#[test]
fn the_past_stays_within_its_memory_and_is_not_lost() {
    const MEMORY: usize = 300_000;
    let mut session = busy();
    session.set_memory(MEMORY);
    let start = session.memory();
    let mut there = vec![session.state_hash()];
    for _ in 0..600 {
        session.step().unwrap();
        there.push(session.state_hash());
        // The beginning is always stored.
        assert!(session.memory() <= MEMORY + start);
    }
    for frame in [599_u64, 598, 590, 300, 301, 17, 600] {
        session.seek(frame);
        session.advance_seek(u64::MAX).unwrap();
        assert_eq!(session.state_hash(), there[frame as usize], "frame {frame}");
        assert!(session.memory() <= MEMORY + start);
    }
    session.set_memory(0);
    assert_eq!(session.memory(), start);
    session.step_back().unwrap();
    assert_eq!(session.state_hash(), there[599]);
}

#[test]
fn the_way_to_a_frame_grows_with_its_distance_from_the_present() {
    let mut session = built_in("simtest1");
    // Memory for some tens of moments.
    session.set_memory(500_000);
    hashes(&mut session, 3000);
    let frames_again = |session: &mut Session, frame: u64| {
        session.seek(frame);
        let frames_again = frame - session.frame();
        session.stop_seeking();
        frames_again
    };
    // All of the last frames are stored. With 1000 moments in 3000 frames, all frames would be near
    // one.
    assert_eq!(frames_again(&mut session, 2999), 0);
    for back in [10, 100, 300, 1000, 2000, 2900] {
        let again = frames_again(&mut session, 3000 - back);
        assert!(again <= back / 2, "{again} frames to go back by {back}");
    }
}
