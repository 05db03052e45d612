//! Links: a session opened from a link equals the session of the link, bit for bit.

use carom::{
    ColliderId, DQuat, DVec3, EmitterId, ForceId, Friction, Mass, Sphere, SphereId, Spring,
    SpringId, StateHash,
};
use carom_scene::scene::{Boundary, Force, Rule, Simulation, Zones};
use carom_scene::{BUILT_IN_FILES, Override, Scene};
use carom_session::{
    Change, Command, Driver, Edit, Link, LinkCamera, LinkSource, Replay, Session, SessionError,
    SphereChange, View,
};

use crate::{built_in, busy, busy_scene, hashes};

/// Numbers that inexact formatting would not preserve.
const AWKWARD: [f64; 6] = [0.1, 1.0 / 3.0, 5e-324, f64::MAX, -0.0, 1.000_000_000_000_000_2];

fn first_sphere(session: &Session) -> SphereId {
    session.world().spheres().ids()[0]
}

/// Writes a link as an address and reads it again.
#[track_caller]
fn copied(link: &Link) -> Link {
    let text = format!("https://example.org/carom/?a=b#{}", link.to_fragment());
    assert!(text.is_ascii() && !text.contains([' ', '"', '<', '>', '`', '\n']), "{text}");
    let copied = Link::parse(&text).unwrap();
    assert_eq!(copied, *link);
    assert_eq!(Link::parse(&link.to_fragment()).unwrap(), *link);
    copied
}

#[track_caller]
fn replayed(link: &Link) -> Session {
    let link = copied(link);
    let mut session = Session::replay(link.open().unwrap(), &link).unwrap();
    session.advance_seek(u64::MAX).unwrap();
    session
}

fn run(link: &Link) -> StateHash {
    let mut replay = Replay::of(link, link.open().unwrap()).unwrap();
    for _ in 0..replay.frame_at(link.time().unwrap()).unwrap() {
        replay.step().unwrap();
    }
    replay.world().state_hash()
}

/// Checks that both ways of repeating a run reproduce the present of this session.
#[track_caller]
pub fn assert_repeats(session: &Session) -> Link {
    let link = session.link();
    let again = replayed(&link);
    assert_eq!((again.frame(), again.time()), (session.frame(), session.time()));
    assert_eq!(again.state_hash(), session.state_hash());
    assert_eq!(again.setup(), session.setup());
    assert_eq!(again.scene(), session.scene());
    assert_eq!(run(&link), session.state_hash());
    link
}

mod built_in_scenes_go_by_their_names_and_as_files_to_the_same_bits {
    // Two tests that run in parallel.
    #[test]
    fn one_half() {
        super::to_the_same_bits(0);
    }

    #[test]
    fn the_other_half() {
        super::to_the_same_bits(1);
    }
}

/// Tests every second scene, starting with number `first`.
fn to_the_same_bits(first: usize) {
    for (file, text) in BUILT_IN_FILES.iter().skip(first).step_by(2) {
        let name = file.trim_end_matches(".toml");
        let mut session = built_in(name);
        // Half a second: by then most scenes have had impacts, and differing bits would differ from
        // the start.
        session.jump(0.5).unwrap();
        let link = assert_repeats(&session);
        assert_eq!(link.to_fragment(), format!("scene={name}&t=0.5"));
        let source = LinkSource::File { name: (*file).to_owned(), text: (*text).to_owned() };
        let whole = Link::new(source).with_time(0.5).unwrap();
        assert_eq!(replayed(&whole).state_hash(), session.state_hash(), "{name} as a file");
        // As an interface writes it, without the file.
        let mut renamed = Scene::clone(session.scene());
        renamed.name = "another".to_owned();
        let written = Link::to_scene(&renamed).with_time(0.5).unwrap();
        assert!(written.to_fragment().starts_with("file="), "{written}");
        assert_eq!(replayed(&written).state_hash(), session.state_hash(), "{name} written");
    }
}

#[test]
fn generators_and_emitters_come_through_as_a_file() {
    let mut session = busy();
    session.jump(3.0).unwrap();
    let link = assert_repeats(&session);
    assert!(matches!(link.source(), LinkSource::File { name, .. } if name == "busy"));
}

#[test]
fn links_are_readable() {
    let overrides = ["emitters.0.max_spheres=100", "simulation.rule=exact", "title=\"a & b\""];
    let overrides = overrides.map(|text| text.parse::<Override>().unwrap());
    let link = Link::new(LinkSource::BuiltIn("simtest4".to_owned()));
    let link = link.with_overrides(overrides).with_time(3.5).unwrap();
    let expected = "scene=simtest4&set=emitters.0.max_spheres=100&rule=exact\
                    &set=title=%22a%20%26%20b%22&t=3.5";
    assert_eq!(link.to_fragment(), expected);
    assert_eq!(copied(&link).open().unwrap().title, "a & b");
    // The result to beat in a game does not change its scene.
    let challenge = link.clone().with_goal(12_300.0).unwrap();
    assert_eq!(challenge.to_fragment(), format!("{expected}&goal=12300"));
    assert_eq!(copied(&challenge).goal(), Some(12_300.0));
    assert_eq!(challenge.open().unwrap(), link.open().unwrap());
    let played = challenge.clone().with_moves("strike 8 0.9 0 0 0").unwrap();
    assert_eq!(copied(&played), played);
    assert_eq!(copied(&played).moves(), Some("strike 8 0.9 0 0 0"));
    assert_eq!(played.without_goal(), link);
    assert_eq!(challenge.without_goal(), link);
    // Times have only as many digits as are needed to identify the frame.
    let mut scene = Scene::clone(built_in("simtest1").scene());
    for (frame_time, frame, time) in
        [(0.02, 17, "0.34"), (1.0 / 60.0, 20, "0.33"), (1e-4, 3333, "0.3333"), (1e-9, 20, "2e-8")]
    {
        scene.simulation.frame_time = frame_time;
        let mut session = Session::new(scene.clone()).unwrap();
        session.seek(frame);
        session.advance_seek(u64::MAX).unwrap();
        let link = assert_repeats(&session);
        assert!(link.to_fragment().ends_with(&format!("&t={time}")), "{link}");
    }
}

#[test]
fn another_rule_of_a_built_in_scene_is_all_that_is_said() {
    let mut scene = Scene::clone(built_in("tutorial1").scene());
    scene.simulation.rule = Rule::Exact;
    let mut session = Session::new(scene.clone()).unwrap();
    session.jump(1.0).unwrap();
    assert_eq!(assert_repeats(&session).to_fragment(), "scene=tutorial1&rule=exact&t=1");
    scene.simulation.frame_time = 0.01;
    assert!(Link::to_scene(&scene).to_fragment().starts_with("file="));
}

#[test]
fn of_several_rules_the_last_counts() {
    let link = Link::parse("scene=simtest1&rule=bisect&set=simulation.rule=discrete").unwrap();
    assert_eq!(copied(&link).open().unwrap().simulation.rule, Rule::Discrete);
}

/// One edit of every kind.
fn edits() -> Vec<Edit> {
    let [a, b, c, d, e, f] = AWKWARD;
    let (vector, array) = (DVec3::new(a, b, c), [d, e, f]);
    let sphere = Sphere::new(vector, f).with_velocity(DVec3::from_array(array));
    let emitter = carom::Emitter::new(sphere.with_density(b), a)
        .with_position(vector)
        .with_rotation(DQuat::from_xyzw(a, b, c, d))
        .with_max_spheres(u32::MAX)
        .with_count(u32::MAX - 1);
    let boundary = Boundary::Periodic {
        size: [f64::INFINITY, b, d],
        shear_rate: a,
        relative_velocities: true,
    };
    let friction = Friction::sliding(a).with_rolling(b).with_spinning(c);
    let simulation = Simulation { frame_time: b, boundary, ..Simulation::default() };
    let all = SphereChange {
        position: Some(vector),
        velocity: Some(DVec3::from_array(array)),
        radius: Some(a),
        mass: Some(b),
        restitution: Some(e),
        friction: Some(friction),
        angular_velocity: Some(DVec3::from_array(array)),
    };
    let silent = SphereChange { friction: Some(Friction::default()), ..SphereChange::default() };
    let [one, other] = [3, u64::MAX / 2].map(SphereId::from_number);
    let between = Spring::between(one, other, a);
    let to_point = Spring::to_point(other, DVec3::from_array(array), e);
    vec![
        Edit::Simulation(Box::new(simulation)),
        Edit::FrameTime(b),
        Edit::Force(ForceId::from_number(0), Force::Gravity { acceleration: array }),
        Edit::Force(ForceId::from_number(1), Force::ViscousDrag { coefficient: c }),
        Edit::AddForce(Force::Constant { force: array }),
        Edit::RemoveForce(ForceId::from_number(7)),
        Edit::AddSpring(between.with_damping(c)),
        Edit::Spring(SpringId::from_number(3), to_point.with_stiffness(b).with_only_pulls(true)),
        Edit::RemoveSpring(SpringId::from_number(u64::MAX / 2)),
        Edit::ColliderRestitution(ColliderId::from_number(3), b),
        Edit::AllColliderRestitutions(f),
        Edit::ColliderFriction(ColliderId::from_number(2), friction.with_tangential_restitution(e)),
        Edit::AllColliderFrictions(Friction::default().with_spinning(f)),
        Edit::ColliderScale(ColliderId::from_number(2), b),
        Edit::NamedColliderRestitutions("left \"peg\"".to_owned(), e),
        Edit::NamedColliderFrictions(String::new(), friction),
        Edit::Emitter(EmitterId::from_number(1), Box::new(emitter)),
        Edit::Emitter(
            EmitterId::from_number(0),
            Box::new(emitter.with_max_spheres(None).with_count(None).with_sphere(sphere)),
        ),
        Edit::Sphere(SphereId::from_number(u64::MAX / 2), Box::new(all)),
        Edit::Sphere(SphereId::from_number(0), Box::default()),
        Edit::Sphere(SphereId::from_number(1), Box::new(silent)),
        Edit::Throw { sphere: Box::new(sphere), color: None },
        Edit::Throw { sphere: Box::new(sphere.with_mass(c)), color: Some([a, b, e]) },
        Edit::RemoveSphere(SphereId::from_number(12)),
    ]
}

/// A view with these changes, without a run.
fn view_with(changes: Vec<Change>) -> View {
    let dated = |(frame, change)| carom_session::PastChange { frame, change };
    let changes: Vec<_> = (0..).step_by(3).zip(changes).map(dated).collect();
    let frame = changes.last().map_or(0, |it| it.frame);
    View { changes: changes.into(), frame, ..View::default() }
}

#[test]
fn every_edit_comes_back_to_the_bit() {
    let mut changes: Vec<Change> = edits().into_iter().map(Change::Edit).collect();
    changes.insert(3, Change::FailedStep);
    let link = copied(&view_with(changes.clone()).link());
    let back: Vec<Change> = link.changes().iter().map(|it| it.change.clone()).collect();
    assert_eq!(back, changes);
    // Equality does not distinguish -0 from 0; the text of a number does.
    assert_eq!(format!("{back:?}"), format!("{changes:?}"));
}

/// A run with edits of all kinds at several frames.
fn edited() -> Session {
    let mut session = busy();
    let mut edit = |frames: u64, edit: Edit| {
        hashes(&mut session, frames);
        session.edit(edit).unwrap();
    };
    edit(0, Edit::AllColliderRestitutions(0.6));
    let push = SphereChange { velocity: Some(DVec3::new(3.0, 4.0, 0.1)), ..Default::default() };
    edit(13, Edit::Sphere(SphereId::from_number(2), Box::new(push)));
    edit(0, Edit::Sphere(SphereId::from_number(2), Box::new(push)));
    edit(7, Edit::FrameTime(0.01));
    edit(
        11,
        Edit::Throw { sphere: Box::new(Sphere::new(DVec3::new(0.0, 5.0, 0.0), 0.3)), color: None },
    );
    edit(5, Edit::AddForce(Force::Constant { force: [0.5, 0.0, 0.0] }));
    edit(5, Edit::RemoveForce(ForceId::from_number(1)));
    edit(
        0,
        Edit::Force(ForceId::from_number(0), Force::Gravity { acceleration: [0.0, -5.0, 0.0] }),
    );
    let ball = SphereId::from_number(4);
    edit(0, Edit::AddSpring(Spring::between(ball, SphereId::from_number(2), 1.0)));
    edit(2, Edit::AddSpring(Spring::to_point(ball, DVec3::Y, 0.5)));
    let anchor = Spring::to_point(SphereId::from_number(2), DVec3::new(0.0, 3.0, 0.0), 1.0);
    edit(1, Edit::Spring(SpringId::from_number(1), anchor.with_stiffness(9.0)));
    edit(9, Edit::RemoveSphere(ball));
    edit(3, Edit::RemoveSpring(SpringId::from_number(1)));
    edit(1, Edit::ColliderRestitution(ColliderId::from_number(1), 0.4));
    let (id, mut emitter) = session.world().emitters().next().map(|(id, it)| (id, *it)).unwrap();
    emitter.period = 0.05;
    emitter.sphere.mass = Mass::Density(700.0);
    let mut edit = |frames: u64, edit: Edit| {
        hashes(&mut session, frames);
        session.edit(edit).unwrap();
    };
    edit(6, Edit::Emitter(id, Box::new(emitter)));
    let simulation = Simulation { rule: Rule::Bisect, ..Simulation::default() };
    edit(20, Edit::Simulation(Box::new(simulation)));
    let simulation = Simulation { rule: Rule::Contact, ..Simulation::default() };
    edit(8, Edit::Simulation(Box::new(simulation)));
    edit(2, Edit::AllColliderFrictions(Friction::sliding(0.4)));
    let rough = Friction::sliding(0.2).with_rolling(0.01).with_spinning(0.02);
    edit(3, Edit::ColliderFriction(ColliderId::from_number(0), rough));
    let (friction, angular_velocity) = (Some(rough), Some(DVec3::new(0.1, 40.0, -3.0)));
    let spun = SphereChange { friction, angular_velocity, ..Default::default() };
    edit(6, Edit::Sphere(SphereId::from_number(2), Box::new(spun)));
    edit(15, Edit::Simulation(Box::default()));
    hashes(&mut session, 30);
    session
}

#[test]
fn a_session_with_edits_is_repeated_from_its_link() {
    let mut session = edited();
    assert_repeats(&session);
    // At any frame, the link contains only the changes up to it.
    let last = session.furthest_frame();
    for frame in [0, 12, 13, 14, 20, 21, 60, last - 30, last] {
        session.seek(frame);
        session.advance_seek(u64::MAX).unwrap();
        let link = assert_repeats(&session);
        assert!(link.changes().iter().all(|it| it.frame <= frame));
    }
    let new = SphereChange { position: Some(DVec3::new(0.1, 7.0, 0.0)), ..Default::default() };
    session.jump(0.3).unwrap();
    session.edit(Edit::Sphere(first_sphere(&session), Box::new(new))).unwrap();
    hashes(&mut session, 25);
    assert_repeats(&session);
}

#[test]
fn a_repeated_session_has_the_whole_past() {
    let session = edited();
    let mut again = replayed(&session.link());
    let mut session = session;
    for frame in [40, 3, 77, 20, 13, 0, session.furthest_frame()] {
        for session in [&mut session, &mut again] {
            session.seek(frame);
            session.advance_seek(u64::MAX).unwrap();
        }
        assert_eq!(again.state_hash(), session.state_hash(), "frame {frame}");
        assert_eq!(again.time(), session.time());
    }
    assert_eq!(again.link(), session.link());
    let readings = |session: &Session| {
        let mut view = View::default();
        session.fill(&mut view);
        view.readings
    };
    assert_eq!(readings(&again), readings(&session));
}

#[test]
fn failed_steps_are_part_of_the_run() {
    let mut scene = busy_scene();
    scene.simulation.exact.max_impacts = 2;
    scene.simulation.exact.zones = Zones::Never;
    let mut session = Session::new(scene).unwrap();
    while session.step().is_ok() {}
    let failed = session.frame();
    assert_repeats(&session);
    session.edit(Edit::FrameTime(1e-4)).unwrap();
    hashes(&mut session, 30);
    let link = assert_repeats(&session);
    assert_eq!(link.changes()[0].change, Change::FailedStep);
    assert_eq!(link.changes()[0].frame, failed);
}

#[test]
fn a_repeated_session_fails_where_the_first_one_did_and_notes_it_in_order() {
    let mut scene = busy_scene();
    scene.simulation.exact.max_impacts = 2;
    scene.simulation.exact.zones = Zones::Never;
    let mut session = Session::new(scene.clone()).unwrap();
    while session.step().is_ok() {}
    let failed = session.frame();
    // An edit that is still to be made when the step fails.
    let mut later = Session::new(busy_scene()).unwrap();
    hashes(&mut later, failed + 5);
    later.edit(Edit::FrameTime(0.01)).unwrap();
    let mut view = View::default();
    later.fill(&mut view);
    let link = Link::to_scene(&scene).at(&view);
    let mut again = Session::replay(scene, &link).unwrap();
    assert!(matches!(again.advance_seek(u64::MAX), Err(SessionError::World(_))));
    assert_eq!(again.frame(), failed);
    let frames: Vec<u64> = again.changes().iter().map(|it| it.frame).collect();
    assert_eq!(frames, [failed, failed + 5]);
    // An edit now comes before the future ones and replaces them.
    again.edit(Edit::FrameTime(1e-4)).unwrap();
    assert_eq!(again.changes().len(), 2);
    hashes(&mut again, 10);
    assert_repeats(&again);
}

#[test]
fn a_run_goes_to_its_time_in_pieces() {
    let session = edited();
    let link = session.link();
    let mut again = Session::replay(link.open().unwrap(), &link).unwrap();
    assert_eq!((again.frame(), again.seeking()), (0, Some(session.frame())));
    while !again.advance_seek(7).unwrap() {}
    assert_eq!(again.state_hash(), session.state_hash());
}

#[test]
fn a_driver_repeats_a_run_and_goes_on() {
    let session = edited();
    let link = session.link();
    let mut driver = Driver::inline(built_in("simtest1"));
    let scene = Box::new(link.open().unwrap());
    driver.send(Command::Replay(scene, Box::new(link.clone()))).unwrap();
    driver.send(Command::ShowStateHash(true)).unwrap();
    driver.update(0.0, || false);
    assert_eq!(driver.view().playback.state_hash, Some(session.state_hash()));
    assert_eq!(driver.view().link(), link);
    // The address stays as short as the one that was opened.
    let base = Link::parse("scene=simtest1&set=simulation.frame_time=0.01").unwrap();
    let scene = Box::new(base.open().unwrap());
    driver.send(Command::Replay(scene, Box::new(base.clone()))).unwrap();
    driver.send(Command::Seek(0.5)).unwrap();
    driver.update(0.0, || false);
    let now = base.at(driver.view());
    assert_eq!(now.to_fragment(), "scene=simtest1&set=simulation.frame_time=0.01&t=0.5");
}

#[test]
fn a_link_looks_from_where_the_camera_was_to_less_than_a_pixel() {
    let written = |camera| {
        let mut link = Link::parse("scene=simtest1&t=1").unwrap();
        link.set_camera(camera);
        link.to_fragment()
    };
    let camera = LinkCamera {
        position: DVec3::new(1.0 / 3.0, 1e-9, -20.5),
        target: DVec3::new(0.0, 2.0, 0.0),
        vertical_fov_degrees: 35.0,
    };
    assert_eq!(written(Some(camera)), "scene=simtest1&t=1&camera=0.333,0,-20.5,0,2,0");
    let wide = LinkCamera { vertical_fov_degrees: 60.0, ..camera };
    assert_eq!(written(Some(wide)), "scene=simtest1&t=1&camera=0.333,0,-20.5,0,2,0,60");
    assert_eq!(written(None), "scene=simtest1&t=1");
    // Far from the origin with a near target, and the reverse.
    for (far, near) in [(1e6, 1e-3), (1e-3, 1e9)] {
        let target = DVec3::splat(far);
        let position = target + near * DVec3::new(0.6, -0.8, 0.0);
        let camera = LinkCamera { position, target, vertical_fov_degrees: 50.0 };
        let read = Link::parse(&written(Some(camera))).unwrap().camera().unwrap();
        assert_eq!(read.vertical_fov_degrees, 50.0);
        // A picture of a thousand lines covers 0.6 of the distance, so a line is 6e-4 of it.
        for (read, place) in [(read.position, position), (read.target, target)] {
            assert!(read.distance(place) < 6e-5 * near, "{read} for {place}");
        }
    }
}

#[test]
fn a_link_without_a_time_begins_at_the_beginning() {
    let link = Link::parse("#scene=simtest1").unwrap();
    let session = Session::replay(link.open().unwrap(), &link).unwrap();
    assert_eq!((link.time(), session.frame(), session.seeking()), (None, 0, None));
}

#[test]
fn changes_after_the_time_of_a_link_come_when_it_goes_on() {
    let session = edited();
    let link = session.link().with_time(0.0).unwrap();
    let mut again = replayed(&link);
    assert_eq!((again.frame(), again.changes().len()), (0, session.changes().len()));
    // Goes to a time for which the session has to predict the lengths of future frames.
    again.jump(session.time()).unwrap();
    assert_eq!((again.frame(), again.state_hash()), (session.frame(), session.state_hash()));
}

#[test]
fn a_change_that_cannot_be_made_again_stops_there_and_says_so() {
    let mut session = busy();
    hashes(&mut session, 10);
    session.edit(Edit::RemoveSphere(SphereId::from_number(1))).unwrap();
    hashes(&mut session, 10);
    session.edit(Edit::AllColliderRestitutions(0.5)).unwrap();
    let mut view = View::default();
    session.fill(&mut view);
    // The same changes in a scene with one sphere.
    let link = Link::parse("scene=simtest1").unwrap().at(&view);
    let scene = link.open().unwrap();
    let mut again = Session::replay(scene.clone(), &link).unwrap();
    let error = again.advance_seek(u64::MAX).unwrap_err();
    assert_eq!(
        error.to_string(),
        "the edit at frame 10 cannot be repeated: there is no sphere 1 in this world"
    );
    assert_eq!((again.frame(), again.seeking(), again.changes().len()), (10, None, 0));
    again.step().unwrap();
    let mut replay = Replay::of(&link, scene).unwrap();
    let failed = (0..20).find_map(|_| replay.step().err()).unwrap();
    assert_eq!(failed.to_string(), error.to_string());
}

#[test]
fn a_scene_is_found_by_its_title_and_in_any_case() {
    let title = built_in("tutorial1").scene().title.clone();
    for name in ["TUTORIAL1", &title] {
        let link = Link::new(LinkSource::BuiltIn(name.to_owned()));
        assert_eq!(copied(&link).open().unwrap().name, "tutorial1");
    }
}

#[test]
fn a_broken_file_in_a_link_is_told_with_its_line() {
    let text = "name = \"two\"\n\n[[spheres]]\nradius = -1\n".to_owned();
    let name = "my scene.toml".to_owned();
    let link = Link::new(LinkSource::File { name, text: text.clone() });
    let error = copied(&link).open().unwrap_err().to_string();
    assert!(error.starts_with("my scene.toml:4: spheres[0].radius: must be"), "{error}");
    let link = Link::new(LinkSource::File { name: String::new(), text });
    let error = copied(&link).open().unwrap_err().to_string();
    assert!(error.starts_with("scene file:4: spheres[0].radius: must be"), "{error}");
}

#[test]
fn an_edit_alone_is_written_as_in_links() {
    let edit = Edit::from_toml("change = { all-collider-restitutions = 0.25 }").unwrap();
    assert_eq!(edit, Edit::AllColliderRestitutions(0.25));
    let text = "change = { sphere = { sphere = 3, changes = { velocity = [0.0, 5.0, 0.0] } } }";
    let change = SphereChange { velocity: Some(DVec3::new(0.0, 5.0, 0.0)), ..Default::default() };
    let edit = Edit::from_toml(text).unwrap();
    assert_eq!(edit, Edit::Sphere(SphereId::from_number(3), Box::new(change)));
}
