//! Measurements.

use carom::{BodyPair, DQuat, DVec3, StageCounts};
use carom_scene::scene::{Rule, Scene, Sphere};
use carom_session::{Edit, MARKED, MAX_POINTS, REMEMBERED, Session, SphereChange, View};

use crate::{busy, busy_scene, hashes};

fn view(session: &Session) -> View {
    let mut view = View::default();
    session.fill(&mut view);
    view
}

/// Two spheres of 1 kg and 3 kg in a line, which approach at 2 m/s with restitution 0.5.
fn two_that_meet(rule: Rule) -> Session {
    Session::new(scene_of_two(rule)).unwrap()
}

fn scene_of_two(rule: Rule) -> Scene {
    let mut scene = Scene::new("two");
    let mut first = Sphere::at([-1.0, 0.0, 0.0], 0.5);
    (first.velocity, first.restitution) = ([2.0, 0.0, 0.0], 0.5);
    let mut second = Sphere::at([1.0, 0.0, 0.0], 0.5);
    second.mass = Some(3.0);
    scene.spheres = vec![first, second];
    scene.simulation.rule = rule;
    scene
}

#[test]
fn an_impact_is_listed_with_its_time_impulse_and_energy() {
    for (rule, tolerance) in [(Rule::Exact, 1e-12), (Rule::Bisect, 1e-4), (Rule::Discrete, 0.02)] {
        let mut session = two_that_meet(rule);
        hashes(&mut session, 60);
        let view = view(&session);
        let [impact] = view.impacts[..] else { panic!("{rule:?}: {:?}", view.impacts) };
        // A gap of 1 m at 2 m/s; the reduced mass is 3/4 kg.
        assert!((impact.time - 0.5).abs() <= tolerance, "{rule:?}: {}", impact.time);
        assert!(matches!(impact.between, BodyPair::Spheres(..)));
        assert_eq!((impact.group_size, impact.normal), (1, DVec3::X));
        let impulse = 0.75 * (1.0 + 0.5) * 2.0;
        assert!((impact.impulse - impulse).abs() < 1e-12, "{rule:?}: {}", impact.impulse);
        let lost = 0.5 * 0.75 * (1.0 - 0.25) * 4.0;
        let change = impact.energy_change.unwrap();
        assert!((change + lost).abs() < 1e-12, "{rule:?}: {change}");
        // The world lost exactly this energy.
        let [first, .., last] = view.readings[..] else { panic!("too few readings") };
        assert!((last.total_energy() - first.total_energy() + lost).abs() < 1e-12);
        assert!((last.momentum - DVec3::new(2.0, 0.0, 0.0)).length() < 1e-12);
    }
}

#[test]
fn the_energy_of_an_impact_with_friction_is_not_told_without_an_account() {
    for (rule, is_told) in [(Rule::Exact, true), (Rule::Contact, false)] {
        let mut scene = scene_of_two(rule);
        let first = &mut scene.spheres[0];
        (first.friction, first.angular_velocity) = (Some(0.3), [0.0, 0.0, 5.0]);
        let mut session = Session::new(scene).unwrap();
        hashes(&mut session, 60);
        let view = view(&session);
        let [impact] = view.impacts[..] else { panic!("{rule:?}: {:?}", view.impacts) };
        assert_eq!(impact.energy_change.is_some(), is_told, "{rule:?}");
    }
}

#[test]
fn marks_fade() {
    let mut session = two_that_meet(Rule::Exact);
    session.jump(0.5 + 0.9 * MARKED).unwrap();
    assert_eq!(view(&session).marks().len(), 1);
    session.jump(0.5 + 1.5 * MARKED).unwrap();
    assert_eq!(view(&session).marks().len(), 0);
    // At an earlier frame, the impact has not occurred.
    session.jump(0.4).unwrap();
    assert!(view(&session).impacts.is_empty());
}

#[test]
fn readings_end_at_the_present_and_begin_at_the_beginning() {
    let mut session = busy();
    hashes(&mut session, 100);
    let there = view(&session).readings;
    assert_eq!(there.len(), 101);
    for frame in [100_usize, 99, 50, 51, 90, 0, 100] {
        session.seek(frame as u64);
        session.advance_seek(u64::MAX).unwrap();
        assert_eq!(view(&session).readings, there[..=frame], "frame {frame}");
    }
}

#[test]
fn each_reading_has_the_work_of_the_frame_that_led_to_it() {
    let mut session = busy();
    assert_eq!(view(&session).now.work, StageCounts::default());
    let mut expected = vec![StageCounts::default()];
    for _ in 0..40 {
        session.step().unwrap();
        expected.push(session.world().report().work);
    }
    let measured: Vec<StageCounts> = view(&session).readings.iter().map(|it| it.work).collect();
    assert_eq!(measured, expected);
    assert!(expected.iter().any(|work| work.pair_tests > 0 && work.events > 0));
    // A restored world has no report; the reading remains.
    session.jump(0.25).unwrap();
    let now = view(&session).now;
    assert_eq!(now.work, expected[15]);
}

#[test]
fn an_edit_is_seen_in_the_readings_at_once() {
    let mut session = busy();
    hashes(&mut session, 30);
    session.jump(0.25).unwrap();
    let before = view(&session).now;
    let id = session.world().spheres().ids()[0];
    let change = SphereChange { mass: Some(100.0), ..SphereChange::default() };
    session.edit(Edit::Sphere(id, Box::new(change))).unwrap();
    let after = view(&session);
    assert!(after.now.kinetic_energy > before.kinetic_energy);
    assert_eq!((after.readings.len(), after.readings.last()), (16, Some(&after.now)));
    session.step_back().unwrap();
    session.step().unwrap();
    assert_eq!(view(&session).readings, after.readings);
}

#[test]
fn a_long_run_is_shown_whole_in_bounded_memory() {
    let mut session = two_that_meet(Rule::Exact);
    hashes(&mut session, 3 * MAX_POINTS as u64);
    let readings = view(&session).readings;
    assert!(readings.len() <= MAX_POINTS + 1, "{} points", readings.len());
    assert!(readings.len() > MAX_POINTS / 2, "{} points", readings.len());
    assert_eq!(readings[0].time, 0.0);
    assert_eq!(readings[readings.len() - 1].time, session.time());
    let times: Vec<f64> = readings.iter().map(|reading| reading.time).collect();
    assert!(times.is_sorted_by(|one, next| one < next));
    // Evenly spaced: no gap is longer than four frames.
    assert!(times.windows(2).all(|pair| pair[1] - pair[0] < 4.5 / 60.0));
}

#[test]
fn the_rate_of_impacts_is_their_number_per_second() {
    // A sphere between two walls with a gap of 1 m, at 20 m/s: 20 impacts per second.
    let mut scene = Scene::new("between walls");
    let mut sphere = Sphere::at([0.0; 3], 0.5);
    sphere.velocity = [20.0, 0.0, 0.0];
    scene.spheres = vec![sphere];
    let wall = "shape = \"half-space\"";
    let text = format!(
        "{}\n[[colliders]]\n{wall}\nposition = [-1.0, 0, 0]\nrotation = [0, 0, -0.5, 0.5]\n\
         [[colliders]]\n{wall}\nposition = [1.0, 0, 0]\nrotation = [0, 0, 0.5, 0.5]\n",
        scene.to_toml()
    );
    let mut session = Session::new(Scene::from_toml(&text, "walls").unwrap()).unwrap();
    hashes(&mut session, 120);
    let view = view(&session);
    // The window may contain one impact more or less.
    assert!((view.now.impact_rate - 20.0).abs() <= 2.0, "{}", view.now.impact_rate);
    assert_eq!(view.now.impacts, view.impacts.len() as u64);
}

#[test]
fn the_picked_sphere_is_shown_from_the_beginning() {
    let mut session = two_that_meet(Rule::Exact);
    hashes(&mut session, 10);
    let id = session.world().spheres().ids()[0];
    session.pick(Some(id));
    hashes(&mut session, 50);
    let there = view(&session);
    assert_eq!(there.picked_readings.len(), 61);
    assert_eq!(
        (there.picked_readings[0].time, there.picked_readings[0].velocity.length()),
        (0.0, 2.0)
    );
    // Of 2 m/s, the centre of mass keeps 0.5 m/s; of the relative 1.5 m/s, half is returned.
    let last = there.picked_readings[60];
    assert!((last.velocity.length() - 0.25).abs() < 1e-12, "{last:?}");
    session.step_back().unwrap();
    assert_eq!(view(&session).picked_readings, there.picked_readings[..60]);
    session.edit(Edit::RemoveSphere(id)).unwrap();
    session.step().unwrap();
    assert_eq!(view(&session).picked, Some(id));
}

#[test]
fn a_sphere_picked_late_has_the_past_of_one_picked_at_once() {
    let mut early = busy();
    let id = early.world().spheres().ids()[3];
    early.pick(Some(id));
    hashes(&mut early, 60);
    let mut late = busy();
    hashes(&mut late, 60);
    late.pick(Some(id));
    assert_eq!(view(&late).picked_readings, view(&early).picked_readings);
    // Measurements after the present are not shown.
    late.pick(None);
    late.jump(0.5).unwrap();
    late.pick(Some(id));
    assert_eq!(view(&late).picked_readings, view(&early).picked_readings[..31]);
}

#[test]
fn only_the_last_impacts_are_remembered() {
    let mut scene = busy_scene();
    scene.colliders[0].restitution = 1.0;
    let mut session = Session::new(scene).unwrap();
    while view(&session).now.impacts < 3 * REMEMBERED as u64 / 2 {
        session.step().unwrap();
    }
    let impacts = view(&session).impacts;
    assert_eq!(impacts.len(), REMEMBERED);
    assert!(impacts.is_sorted_by_key(|impact| impact.time));
}

/// A ball of 3 kg in a closed box whose walls are four radii apart; it hits both walls of an axis.
fn one_in_a_box(speed: f64) -> Session {
    let text = format!(
        "name = \"box\"\nspheres = [{{ position = [0, 0, 0], radius = 0.5, mass = 3.0, velocity = [{speed}, 0, 0] }}]\n\
         colliders = [{{ shape = {{ container = {{ size = [2.0, 2.0, 2.0] }} }} }}]"
    );
    Session::new(Scene::from_toml(&text, "box").unwrap()).unwrap()
}

#[test]
fn pressure_in_a_container_is_the_force_on_its_walls_by_their_area() {
    let mut session = one_in_a_box(40.0);
    hashes(&mut session, 60);
    // 40 impacts per second of 2 m u = 240 N s on 24 m² are 400 Pa; the window may contain one
    // impact more or less.
    let pressure = view(&session).now.pressure.unwrap();
    assert!((pressure - 400.0).abs() <= 1.05 * 240.0 / 24.0 / 0.5, "{pressure}");
    assert_eq!(view(&busy()).now.pressure, None, "a floor alone shuts nothing in");
}

/// The ball of [`one_in_a_box`] between half-spaces with these normals at a distance of 1 m.
fn one_in_half_spaces(normals: &[[f64; 3]]) -> Session {
    let wall = |[x, y, z]: &[f64; 3]| {
        let position = format!("[{}, {}, {}]", -x, -y, -z);
        format!(
            "{{ shape = 'half-space', position = {position}, rotation = {{ normal = [{x}, {y}, {z}] }} }}"
        )
    };
    let walls: Vec<String> = normals.iter().map(wall).collect();
    let text = format!(
        "name = 'box'\nspheres = [{{ radius = 0.5, mass = 3.0, velocity = [24.0, 32.0, 0] }}]\n\
         colliders = [{}]",
        walls.join(", ")
    );
    Session::new(Scene::from_toml(&text, "box").unwrap()).unwrap()
}

#[test]
fn pressure_in_a_box_of_half_spaces_is_the_force_on_its_walls_by_their_area() {
    // Turned about z, so that the ball still moves straight from wall to wall.
    let (turned, across) = ([0.6, 0.8, 0.0], [-0.8, 0.6, 0.0]);
    let opposite = |it: [f64; 3]| it.map(|along| -along);
    let z = [0.0, 0.0, 1.0];
    let walls = [turned, z, across, opposite(turned), opposite(z), opposite(across)];
    let mut session = one_in_half_spaces(&walls);
    hashes(&mut session, 60);
    // As in the container: 400 Pa.
    let pressure = view(&session).now.pressure.unwrap();
    assert!((pressure - 400.0).abs() <= 1.05 * 240.0 / 24.0 / 0.5, "{pressure}");
    // An open box, one with more than six walls, or one with slanting walls has no known area.
    let slanting = [[0.6, 0.0, 0.8], z, across, opposite(turned), opposite(z), opposite(across)];
    for walls in [&walls[..5], &[&walls[..], &[[0.0, 0.6, 0.8]]].concat(), &slanting] {
        assert_eq!(view(&one_in_half_spaces(walls)).now.pressure, None);
    }
}

#[test]
fn one_sphere_alone_has_no_temperature_and_two_opposite_ones_that_of_their_motion() {
    assert_eq!(view(&one_in_a_box(40.0)).now.thermal_energy, 0.0);
    let text = "name = \"two\"\n\
         [simulation]\nboundary = { periodic = { size = [4.0, 4.0, 4.0] } }\n\
         [[spheres]]\nposition = [-1, 0, 0]\nradius = 0.5\nmass = 2.0\nvelocity = [3, 5, 0]\n\
         [[spheres]]\nposition = [1, 0, 0]\nradius = 0.5\nmass = 2.0\nvelocity = [-3, 5, 0]\n";
    let mut session = Session::new(Scene::from_toml(text, "two").unwrap()).unwrap();
    // m v² along the only direction of the relative motion.
    assert_eq!(view(&session).now.thermal_energy, 18.0);
    // Between impacts they approach over 2 m at 6 m/s; each impact has J = 2 μ 6 m/s = 12 N s.
    let (rate, distance, impulse) = (3.0, 1.0, 12.0);
    hashes(&mut session, 180);
    // The relative motion, and so the pressure, is along x only.
    let of_impacts = distance * impulse * rate / 64.0;
    let expected = 2.0 * 18.0 / 64.0 + of_impacts;
    let pressure = view(&session).now.pressure.unwrap();
    // The window may contain one impact more or less than 1.5.
    assert!((pressure - expected).abs() <= 0.7 * of_impacts, "{pressure} {expected}");
}

#[test]
fn previous_positions_are_those_a_frame_ago_for_the_spheres_that_were_there() {
    let mut session = busy();
    let mut before = view(&session).spheres;
    let mut seen = 0;
    for _ in 0..120 {
        session.step().unwrap();
        let now = view(&session).spheres;
        for (i, id) in now.ids.iter().enumerate() {
            let expected = match before.index_of(*id) {
                Some(place) => before.positions[place],
                None => now.positions[i],
            };
            assert_eq!(now.previous_positions[i], expected);
        }
        seen += usize::from(now.ids != before.ids);
        before = now;
    }
    assert!(seen > 10, "spheres hardly ever came or went");
}

#[test]
fn a_view_filled_again_and_again_is_like_a_fresh_one() {
    let mut session = busy();
    let mut reused = View::default();
    for frame in 0..100 {
        session.step().unwrap();
        if frame == 50 {
            session.jump(0.2).unwrap();
        }
        session.fill(&mut reused);
        assert_eq!(reused.spheres, view(&session).spheres, "frame {frame}");
    }
    // Another session of the same scene has the same stamps but other spheres.
    let mut other = busy();
    other.step().unwrap();
    other.fill(&mut reused);
    assert_eq!(reused.spheres, view(&other).spheres);
}

#[test]
fn previous_orientations_are_those_a_frame_ago_for_the_spheres_that_were_there() {
    let mut session = busy();
    session.step().unwrap();
    let spheres = view(&session).spheres;
    assert!(spheres.orientations.is_empty() && spheres.previous_orientations.is_empty());
    assert_eq!(spheres.orientation(0, 0.5), None);
    // Far from all others, so that it keeps rotating.
    let speed = 3.0;
    let sphere = carom::Sphere::new(DVec3::splat(1e3), 0.1).with_angular_velocity(speed * DVec3::Z);
    session.edit(Edit::Throw { sphere: Box::new(sphere), color: None }).unwrap();
    let mut before = view(&session).spheres;
    let thrown = *before.ids.last().unwrap();
    for frame in 0..60 {
        session.step().unwrap();
        let now = view(&session).spheres;
        assert_eq!(now.orientations, session.world().spheres().orientations());
        for (i, id) in now.ids.iter().enumerate() {
            let expected = match before.index_of(*id) {
                Some(place) => before.orientations[place],
                None => now.orientations[i],
            };
            assert_eq!(now.previous_orientations[i], expected);
        }
        let halfway = now.orientation(now.index_of(thrown).unwrap(), 0.5).unwrap();
        let angle = speed * session.frame_time() * (f64::from(frame) + 0.5);
        // The middle of the chord is the middle of the arc; about sixty rounding errors.
        assert!(halfway.angle_between(DQuat::from_rotation_z(angle)) < 1e-6, "frame {frame}");
        before = now;
    }
}
