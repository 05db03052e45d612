//! Drivers with and without a thread.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

use carom::{DVec3, StateHash};
use carom_scene::Scene;
use carom_scene::scene::{ImpactLaw, Integrator, Rule, Simulation, Zones};
use carom_session::{
    Command, Comparison, Driver, Edit, FASTEST, Link, Session, SessionError, View, Watched,
};

use crate::{built_in, busy, busy_scene, hashes};

/// Longer than any step of these tests on a shared machine \[s\].
const PATIENCE: Duration = Duration::from_secs(30);

/// Creates a driver with a thread, and a receiver of its news.
fn threaded(session: Session) -> (Driver, Receiver<()>) {
    let (sender, news) = channel();
    // The test may end before the thread.
    let on_news = Box::new(move || _ = sender.send(()));
    (Driver::threaded(session, on_news).unwrap(), news)
}

/// Waits until the view satisfies `is_it`.
fn wait_for(driver: &mut Driver, news: &Receiver<()>, is_it: impl Fn(&View) -> bool) {
    let start = Instant::now();
    driver.update(0.0, || true);
    while !is_it(driver.view()) {
        assert!(start.elapsed() < PATIENCE, "still at {:?}", driver.view().playback);
        let _ = news.recv_timeout(Duration::from_millis(20));
        driver.update(0.0, || true);
    }
}

fn send(driver: &mut Driver, commands: impl IntoIterator<Item = Command>) {
    commands.into_iter().for_each(|command| driver.send(command).unwrap());
}

/// A scene that fails when its ball reaches the floor, because it exceeds the limit on impacts.
fn failing() -> Session {
    let mut scene = busy_scene();
    scene.simulation.exact.max_impacts = 1;
    scene.simulation.exact.zones = Zones::Never;
    Session::new(scene).unwrap()
}

#[test]
fn in_place_frames_follow_the_time_given() {
    let mut driver = Driver::inline(busy());
    driver.update(1.0, || false);
    assert_eq!(driver.view().frame, 0);
    send(&mut driver, [Command::Play]);
    // Time while stopped does not count.
    driver.update(1.0, || false);
    assert_eq!(driver.view().frame, 0);
    (0..10).for_each(|_| _ = driver.update(0.1, || false));
    assert!((59..=60).contains(&driver.view().frame), "{}", driver.view().frame);
    send(&mut driver, [Command::Speed(0.5)]);
    (0..10).for_each(|_| _ = driver.update(0.1, || false));
    assert!((89..=90).contains(&driver.view().frame), "{}", driver.view().frame);
    send(&mut driver, [Command::Pause]);
    driver.update(1.0, || false);
    assert!((89..=90).contains(&driver.view().frame));
    assert!(!driver.view().playback.playing);
}

#[test]
fn in_place_a_piece_of_work_is_done_even_without_time() {
    let mut driver = Driver::inline(busy());
    send(&mut driver, [Command::Seek(0.5), Command::Step]);
    let mut updates = 0;
    while driver.view().frame < 31 || driver.view().seeking.is_some() {
        driver.update(0.0, || true);
        updates += 1;
        assert!(updates < 100);
    }
    // One update per frame of the seek, and one for the step.
    assert_eq!(updates, 32);
    let mut stepped = busy();
    let there = hashes(&mut stepped, 31);
    send(&mut driver, [Command::ShowStateHash(true)]);
    driver.update(0.0, || false);
    assert_eq!(driver.view().playback.state_hash, Some(there[31]));
}

#[test]
fn frames_that_were_not_taken_for_lack_of_time_come_later() {
    let mut driver = Driver::inline(busy());
    send(&mut driver, [Command::Play]);
    driver.update(0.0, || false);
    driver.update(0.1, || true);
    assert_eq!(driver.view().frame, 1);
    assert_eq!(driver.seconds_to_work(), Some(0.0));
    driver.update(0.0, || false);
    assert!(driver.seconds_to_work().is_some_and(|seconds| seconds > 0.0));
    assert!((5..=6).contains(&driver.view().frame), "{}", driver.view().frame);
}

#[test]
fn commands_are_obeyed_in_the_order_sent() {
    let (mut driver, news) = threaded(busy());
    let mut stepped = busy();
    let there = hashes(&mut stepped, 40);
    let steps = std::iter::repeat_n(Command::Step, 3);
    send(&mut driver, [Command::ShowStateHash(true), Command::Seek(0.5)]);
    send(&mut driver, steps);
    send(&mut driver, [Command::StepBack]);
    wait_for(&mut driver, &news, |view| view.frame == 32 && view.furthest_frame == 33);
    assert_eq!(driver.view().playback.state_hash, Some(there[32]));
    send(&mut driver, [Command::Restart, Command::Step, Command::StepBack, Command::Step]);
    wait_for(&mut driver, &news, |view| view.frame == 1);
    assert_eq!(driver.view().playback.state_hash, Some(there[1]));
}

#[test]
fn on_its_thread_time_goes_on_by_its_own_clock_until_it_is_paused() {
    let (mut driver, news) = threaded(busy());
    let start = Instant::now();
    send(&mut driver, [Command::Speed(FASTEST), Command::Play]);
    wait_for(&mut driver, &news, |view| view.time > 1.0);
    assert!(start.elapsed().as_secs_f64() * FASTEST > 1.0, "faster than its clock");
    send(&mut driver, [Command::Pause]);
    wait_for(&mut driver, &news, |view| !view.playback.playing);
    let frame = driver.view().frame;
    std::thread::sleep(Duration::from_millis(50));
    driver.update(0.0, || true);
    assert_eq!(driver.view().frame, frame);
    // The same bits as without a clock.
    let mut stepped = busy();
    let there = hashes(&mut stepped, frame);
    send(&mut driver, [Command::ShowStateHash(true)]);
    wait_for(&mut driver, &news, |view| view.playback.state_hash.is_some());
    assert_eq!(driver.view().playback.state_hash, there.last().copied());
}

#[test]
fn the_thread_ends_when_the_driver_is_dropped() {
    for plays in [false, true] {
        let alive = Arc::new(());
        let held = alive.clone();
        let on_news = Box::new(move || drop(held.clone()));
        let mut driver = Driver::threaded(busy(), on_news).unwrap();
        if plays {
            send(&mut driver, [Command::Play]);
        } else {
            // The thread sleeps without a time limit.
            std::thread::sleep(Duration::from_millis(20));
        }
        drop(driver);
        let start = Instant::now();
        while Arc::strong_count(&alive) > 1 {
            assert!(start.elapsed() < PATIENCE, "the thread lives on");
            std::thread::sleep(Duration::from_millis(1));
        }
    }
}

#[test]
fn a_failing_step_pauses_and_says_why() {
    let (mut driver, news) = threaded(failing());
    send(&mut driver, [Command::Speed(FASTEST), Command::Play]);
    wait_for(&mut driver, &news, |view| view.playback.error.is_some());
    let view = driver.view();
    assert!(!view.playback.playing);
    let error = view.playback.error.as_deref().unwrap();
    assert!(matches!(error, SessionError::World(carom::Error::TooManyImpacts { .. })));
    assert!(error.to_string().contains("max_impacts"), "{error}");
    // Nothing is lost: the previous frame and the past exist.
    let frame = view.frame;
    assert!(frame > 0);
    send(&mut driver, [Command::StepBack]);
    wait_for(&mut driver, &news, |view| view.frame == frame - 1);
    assert!(driver.view().playback.error.is_none());
    // With a higher limit on impacts it continues.
    let mut simulation = driver.view().setup.simulation.clone();
    simulation.exact.max_impacts = 1000;
    send(&mut driver, [Command::Edit(Edit::Simulation(Box::new(simulation)))]);
    send(&mut driver, [Command::Step, Command::Step, Command::Step]);
    wait_for(&mut driver, &news, |view| view.frame == frame + 2);
    assert!(driver.view().playback.error.is_none());
}

#[test]
fn a_refused_edit_says_why_and_time_goes_on() {
    let mut driver = Driver::inline(busy());
    send(&mut driver, [Command::Play, Command::Edit(Edit::FrameTime(-1.0))]);
    driver.update(0.0, || false);
    driver.update(0.1, || false);
    let playback = &driver.view().playback;
    assert!(playback.playing && driver.view().frame > 0);
    let error = playback.error.as_deref().unwrap().to_string();
    assert!(error.contains("frame_time"), "{error}");
}

#[test]
fn edits_of_a_dragged_slider_do_not_pile_up() {
    // Commands that cannot be merged are eventually refused with an error.
    let mut driver = Driver::inline(busy());
    let refused = (0..100_000).find_map(|_| driver.send(Command::Step).err());
    assert!(matches!(refused, Some(SessionError::Busy)));
    let mut dragged = Driver::inline(busy());
    for i in 0..100_000 {
        let restitution = f64::from(i) / 100_000.0;
        send(&mut dragged, [Command::Edit(Edit::AllColliderRestitutions(restitution))]);
    }
    dragged.update(0.0, || false);
    assert_eq!(dragged.view().setup.colliders[0].1.restitution, 0.99999);
}

#[test]
fn another_seek_takes_the_place_of_one_under_way() {
    let mut driver = Driver::inline(busy());
    send(&mut driver, [Command::Seek(1e6)]);
    driver.update(0.0, || true);
    driver.update(0.0, || true);
    assert!(driver.view().seeking.is_some());
    send(&mut driver, [Command::Seek(0.1)]);
    driver.update(0.0, || false);
    assert_eq!((driver.view().frame, driver.view().seeking), (6, None));
}

#[test]
fn a_way_elsewhere_is_given_up_at_once_whatever_waits() {
    let mut driver = Driver::inline(busy());
    send(&mut driver, [Command::ShowStateHash(true), Command::Seek(1e6)]);
    send(&mut driver, [Command::Pick(None), Command::Step, Command::Play, Command::Pause]);
    let mut budget = 20;
    let mut update = |driver: &mut Driver| {
        driver.update(0.0, || {
            budget -= 1;
            budget % 10 == 0
        });
    };
    update(&mut driver);
    let on_the_way = driver.view().frame;
    assert!(driver.view().seeking.is_some() && on_the_way > 0);
    send(&mut driver, [Command::ShowStateHash(false), Command::StopSeeking]);
    update(&mut driver);
    // The waiting step is taken at the frame reached.
    assert_eq!((driver.view().frame, driver.view().seeking), (on_the_way + 1, None));
    assert_eq!(driver.view().playback.state_hash, None);
}

#[test]
fn on_the_way_elsewhere_time_can_be_stopped_and_made_faster() {
    let mut driver = Driver::inline(busy());
    send(&mut driver, [Command::Play, Command::Seek(1e6)]);
    driver.update(0.0, || true);
    driver.update(0.0, || true);
    assert!(driver.view().playback.playing && driver.view().seeking.is_some());
    send(&mut driver, [Command::Pause, Command::Speed(2.0)]);
    driver.update(0.0, || true);
    driver.update(0.0, || true);
    let playback = &driver.view().playback;
    assert_eq!((playback.playing, playback.speed), (false, 2.0));
    assert!(driver.view().seeking.is_some());
}

#[test]
fn another_scene_is_opened_or_the_old_one_stays() {
    let (mut driver, news) = threaded(busy());
    let tutorial = built_in("tutorial1").scene().as_ref().clone();
    send(&mut driver, [Command::Step, Command::Open(Box::new(tutorial))]);
    wait_for(&mut driver, &news, |view| view.scene.name == "tutorial1");
    assert_eq!(driver.view().frame, 0);
    let nameless = Scene::new("");
    send(&mut driver, [Command::Step, Command::Open(Box::new(nameless))]);
    wait_for(&mut driver, &news, |view| view.playback.error.is_some());
    assert_eq!((driver.view().scene.name.as_str(), driver.view().frame), ("tutorial1", 1));
}

/// Two simulations of the busy scene with different rules.
fn simulations(rules: [Rule; 2]) -> Option<Box<[Simulation; 2]>> {
    let of = |rule| Simulation { rule, ..busy_scene().simulation };
    Some(Box::new(rules.map(of)))
}

#[test]
fn two_rules_are_driven_like_one() {
    let mut driver = Driver::inline(busy());
    send(&mut driver, [Command::Compare(simulations([Rule::Exact, Rule::Bisect]))]);
    send(&mut driver, [Command::ShowStateHash(true), Command::Seek(0.5), Command::StepBack]);
    driver.update(0.0, || false);
    let view = driver.view();
    let other = view.other.as_deref().unwrap();
    assert_eq!((view.frame, other.frame, view.distances.len()), (29, 29, 30));
    assert_ne!(view.playback.state_hash, other.playback.state_hash);
    // Back to one session.
    send(&mut driver, [Command::Compare(None)]);
    driver.update(0.0, || false);
    assert!(driver.view().other.is_none() && driver.view().distances.is_empty());
    let both = Comparison::new(&busy_scene(), [Rule::Exact, Rule::Discrete]).unwrap();
    assert!(Driver::inline(both).view().other.is_some());
}

#[test]
fn a_comparison_begins_at_the_time_of_now_with_what_was_changed() {
    let mut driver = Driver::inline(busy());
    let exact = busy_scene().simulation;
    send(&mut driver, [Command::Seek(0.2), Command::Edit(Edit::AllColliderRestitutions(0.4))]);
    send(&mut driver, [Command::Seek(0.5), Command::ShowStateHash(true)]);
    driver.update(0.0, || false);
    let alone = driver.view().playback.state_hash;
    send(&mut driver, [Command::Compare(simulations([Rule::Exact, Rule::Contact]))]);
    driver.update(0.0, || false);
    let view = driver.view();
    assert_eq!((view.frame, view.playback.state_hash), (30, alone));
    let other = view.other.as_deref().unwrap();
    assert_eq!(other.setup.colliders[0].1.restitution, 0.4);
    // Two settings of one rule, and from there another pair.
    let mut sequential = exact.clone();
    sequential.exact.impact_law = ImpactLaw::Sequential;
    send(&mut driver, [Command::Compare(Some(Box::new([exact, sequential])))]);
    driver.update(0.0, || false);
    let laws = |view: &View| view.setup.simulation.exact.impact_law;
    let view = driver.view();
    assert_eq!(laws(view.other.as_deref().unwrap()), ImpactLaw::Sequential);
    assert_eq!((laws(view), view.playback.state_hash), (ImpactLaw::default(), alone));
    send(&mut driver, [Command::Compare(None)]);
    driver.update(0.0, || false);
    assert_eq!(driver.view().playback.state_hash, alone);
}

#[test]
fn a_nudged_copy_differs_by_the_nudge_alone_until_balls_meet() {
    let scene = built_in("tutorial3").scene().as_ref().clone();
    let mut driver = Driver::inline(Session::new(scene).unwrap());
    send(&mut driver, [Command::Step, Command::ShowStateHash(true)]);
    driver.update(0.0, || false);
    let ball = driver.view().spheres.ids[0];
    let nudge = |size| Command::Nudge(ball, size * DVec3::Y);
    send(&mut driver, [nudge(1e-9)]);
    driver.update(0.0, || false);
    let view = driver.view();
    let other = view.other.as_deref().expect("a copy");
    assert_eq!((view.frame, other.frame), (1, 1));
    assert_eq!(other.setup.simulation, view.setup.simulation);
    let largest = |driver: &Driver| driver.view().distances.last().map(|it| it.largest);
    // Rounding of a place near 1 m.
    assert!((largest(&driver).unwrap() - 1e-9).abs() < 1e-15, "{:?}", largest(&driver));
    // Impacts of round balls enlarge it.
    send(&mut driver, [Command::Seek(4.0)]);
    driver.update(0.0, || false);
    assert!(largest(&driver).unwrap() > 2e-9, "{:?}", largest(&driver));
    // A second nudge moves the copy only; undoing it makes both as they were.
    let before = both_hashes(&driver);
    send(&mut driver, [nudge(1e-3)]);
    driver.update(0.0, || false);
    assert_ne!(both_hashes(&driver)[1], before[1]);
    send(&mut driver, [Command::Undo]);
    driver.update(0.0, || false);
    assert_eq!(both_hashes(&driver), before);
    send(&mut driver, [Command::Compare(None), Command::Edit(Edit::RemoveSphere(ball))]);
    send(&mut driver, [nudge(1e-3)]);
    driver.update(0.0, || false);
    let view = driver.view();
    assert!(view.other.is_none() && view.playback.error.is_some(), "the ball is gone");
}

#[test]
fn a_link_leads_to_both_of_two_runs() {
    let scene = || built_in("tutorial3").scene().as_ref().clone();
    let ball = Driver::inline(built_in("tutorial3")).view().spheres.ids[0];
    let bounce = Edit::AllColliderRestitutions(0.5);
    let two_rules = Command::Compare(simulations([Rule::Exact, Rule::Discrete]));
    for side_by_side in [Command::Nudge(ball, 1e-9 * DVec3::Y), two_rules] {
        let mut driver = Driver::inline(Session::new(scene()).unwrap());
        let edits = [Command::Seek(0.5), Command::Edit(bounce.clone())];
        send(&mut driver, edits);
        driver.update(0.0, || false);
        send(&mut driver, [side_by_side, Command::Seek(4.0), Command::ShowStateHash(true)]);
        driver.update(0.0, || false);
        let (hashes, link) = (both_hashes(&driver), driver.view().link());
        assert!(hashes[1].is_some() && hashes[1] != hashes[0]);
        let copied = Link::parse(&link.to_fragment()).unwrap();
        assert_eq!(copied, link);
        let opened = Watched::replay(copied.open().unwrap(), &copied).unwrap();
        let mut again = Driver::inline(opened);
        send(&mut again, [Command::ShowStateHash(true)]);
        again.update(0.0, || false);
        assert_eq!(both_hashes(&again), hashes, "{link}");
        assert_eq!(again.view().link(), link);
        // A link to one run again, once the second is closed.
        send(&mut again, [Command::Compare(None)]);
        again.update(0.0, || false);
        assert!(!again.view().link().to_fragment().contains("beside"));
    }
}

/// State hashes of both runs.
fn both_hashes(driver: &Driver) -> [Option<StateHash>; 2] {
    let view = driver.view();
    let other = view.other.as_deref();
    [view.playback.state_hash, other.and_then(|it| it.playback.state_hash)]
}

#[test]
fn a_pair_that_makes_no_sense_leaves_what_is_shown() {
    let mut driver = Driver::inline(busy());
    let mut pair = simulations([Rule::Exact, Rule::Discrete]).unwrap();
    pair[1].discrete.integrator = Integrator::VelocityVerlet;
    pair[0].frame_time = -1.0;
    send(&mut driver, [Command::Seek(0.5), Command::Compare(Some(pair))]);
    driver.update(0.0, || false);
    let view = driver.view();
    assert!(view.other.is_none() && view.playback.error.is_some() && view.frame == 30);
}

#[test]
fn after_a_step_a_picture_shows_the_whole_frame() {
    let mut driver = Driver::inline(busy());
    send(&mut driver, [Command::Speed(0.1), Command::Play]);
    driver.update(0.0, || false);
    driver.update(0.21, || false);
    let blend = driver.blend();
    assert!(driver.view().frame == 1 && (blend - 0.26).abs() < 1e-9, "{blend}");
    send(&mut driver, [Command::Step]);
    driver.update(0.0, || false);
    assert_eq!(driver.blend(), 1.0);
}
