//! Recordings are played back exactly as they were run, and broken ones are refused with the line.
#![cfg(feature = "recording")]
#![allow(missing_docs)]

use std::path::Path;

use carom::World;
use carom_scene::recording::{LineProblem, Playback, Replay, ReplayError, ReplayFrame, Trajectory};
use carom_scene::scene::{Rule, Sphere};
use carom_scene::{Library, Scene};

const FILE: &str = "t.csv";

fn scene(name: &str, rule: Rule) -> Scene {
    let (mut scene, _) = Library::new().find(name, &[]).unwrap();
    scene.simulation.rule = rule;
    scene
}

/// Runs a scene and records every `every`-th frame; returns the world after each frame.
fn record(scene: &Scene, frames: usize, every: usize, path: &Path) -> Vec<World> {
    let mut table = Trajectory::create(path).unwrap();
    let mut world = scene.world().unwrap();
    let mut worlds = Vec::new();
    for frame in 1..=frames {
        world.step(scene.simulation.frame_time).unwrap();
        if frame.is_multiple_of(every) {
            table.write(&world).unwrap();
        }
        worlds.push(world.clone());
    }
    table.finish().unwrap();
    worlds
}

#[track_caller]
fn assert_same(frame: &ReplayFrame, world: &World) {
    assert_eq!(frame.time, world.time());
    let spheres = world.spheres();
    assert_eq!(frame.balls.len(), spheres.len());
    for (i, ball) in frame.balls.iter().enumerate() {
        assert_eq!(ball.number, spheres.ids()[i].number());
        assert_eq!(ball.position, spheres.positions()[i]);
        assert_eq!(ball.velocity, spheres.velocities()[i]);
        let turned = world.has_spin().then(|| spheres.get(i).orientation);
        assert_eq!(ball.orientation, turned);
        assert_eq!(ball.radius, spheres.radii()[i]);
        assert_eq!(ball.mass, spheres.masses()[i]);
    }
}

#[test]
fn a_replay_has_the_same_bits_as_the_run() {
    let folder = tempfile::tempdir().unwrap();
    for (name, rule) in [
        ("simtest1", Rule::Exact),
        ("simtest1", Rule::Discrete),
        ("simtest6", Rule::Exact),
        ("tutorial1", Rule::Bisect),
    ] {
        let path = folder.path().join(FILE);
        let scene = scene(name, rule);
        let worlds = record(&scene, 150, 1, &path);
        let mut replay = Replay::open(&path, &scene).unwrap();
        for world in &worlds {
            assert_same(&replay.next_frame().unwrap().unwrap(), world);
        }
        assert_eq!(replay.next_frame().unwrap(), None);
    }
}

#[test]
fn balls_are_turned_as_in_the_run() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(FILE);
    let mut scene = scene("simtest1", Rule::Exact);
    scene.emitters[0].sphere.angular_velocity = [1.0, -20.0, 3.0];
    scene.spheres =
        vec![Sphere { orientation: [0.0, 0.6, 0.0, 0.8], ..Sphere::at([90.0, 90.0, 0.0], 0.5) }];
    let worlds = record(&scene, 60, 1, &path);
    assert!(worlds[59].spheres().orientations()[1].w.abs() < 0.99, "an emitted ball has turned");
    let mut replay = Replay::open(&path, &scene).unwrap();
    assert_same(replay.start(), &scene.world().unwrap());
    for world in &worlds {
        assert_same(&replay.next_frame().unwrap().unwrap(), world);
    }
}

/// Emitters of different spheres, some of which emit at the same times.
#[test]
fn every_ball_is_that_of_its_emitter() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(FILE);
    for rule in [Rule::Exact, Rule::Discrete, Rule::Bisect] {
        let mut scene = scene("simtest1", rule);
        scene.spheres = vec![Sphere::at([90.0, 90.0, 0.0], 0.5)];
        let first = scene.emitters[0].clone();
        for (i, period) in [(1, 0.011), (2, 0.1), (3, 0.25)] {
            let mut emitter = first.clone();
            emitter.position[0] += 20.0 * f64::from(i);
            emitter.period = period;
            emitter.max_spheres = Some(4);
            emitter.sphere.diameter = None;
            emitter.sphere.radius = Some(0.1 + 0.01 * f64::from(i));
            emitter.sphere.color = Some([0.1 * f64::from(i); 3]);
            scene.emitters.push(emitter);
        }
        let worlds = record(&scene, 60, 7, &path);
        let mut replay = Replay::open(&path, &scene).unwrap();
        for world in worlds.iter().skip(6).step_by(7) {
            let frame = replay.next_frame().unwrap().unwrap();
            assert_same(&frame, world);
            for ball in &frame.balls {
                let emitter =
                    scene.emitters[1..].iter().find(|it| it.sphere.radius == Some(ball.radius));
                let color = emitter.and_then(|emitter| emitter.sphere.color);
                assert_eq!(ball.color, color.or(first.sphere.color).filter(|_| ball.number > 0));
            }
        }
    }
}

#[test]
fn a_film_at_the_rate_of_the_recording_shows_its_frames() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(FILE);
    let scene = scene("simtest1", Rule::Exact);
    let worlds = record(&scene, 200, 1, &path);
    // simtest1 has 50 frames per second, so a film of 25 shows every second one.
    let rate = (1.0 / scene.simulation.frame_time).round();
    let mut playback = Playback::new(Replay::open(&path, &scene).unwrap()).unwrap();
    assert_same(&playback.at(0.0).unwrap().unwrap(), &scene.world().unwrap());
    for frame in (2..=200).step_by(2) {
        let found = playback.at(frame as f64 / rate).unwrap().unwrap();
        assert_same(&found, &worlds[frame - 1]);
    }
    assert_eq!(playback.at(201.0 / rate).unwrap(), None);
}

#[test]
fn between_frames_balls_fly_on() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(FILE);
    let mut scene = scene("simtest1", Rule::Exact);
    scene.colliders.clear();
    let worlds = record(&scene, 120, 6, &path);
    let mut playback = Playback::new(Replay::open(&path, &scene).unwrap()).unwrap();
    for world in &worlds[6..] {
        let frame = playback.at(world.time()).unwrap().unwrap();
        let spheres = world.spheres();
        for ball in &frame.balls {
            let index = spheres.ids().iter().position(|id| id.number() == ball.number).unwrap();
            // Only gravity acts, so the curve is exact up to rounding at 10 m over a frame.
            let error = ball.position.distance(spheres.positions()[index]);
            assert!(error < 1e-12, "{error} at {}", world.time());
        }
    }
}

/// Errors of tables without rows and of tables that are cut short.
#[test]
fn a_table_without_rows_or_with_half_a_line_is_no_recording() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("t.csv");
    let (scene, _) = Library::new().find("tutorial1", &[]).unwrap();
    let opened = |text: &str| {
        std::fs::write(&path, text).unwrap();
        Replay::open(&path, &scene).and_then(|mut replay| replay.next_frame())
    };
    let header = "t,ball,x,y,z,vx,vy,vz\n";
    assert!(matches!(opened(header), Err(ReplayError::Empty { .. })));
    let row = "1e0,0,1,2,3,4,5,6.25";
    assert!(matches!(opened(&format!("{header}{row}")), Err(ReplayError::CutShort { .. })));
    assert!(opened(&format!("{header}{row}\n")).unwrap().is_some());
}

fn refusal(header: &str, rows: &[&str]) -> ReplayError {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(FILE);
    std::fs::write(&path, format!("{header}\n{}\n", rows.join("\n"))).unwrap();
    let (scene, _) = Library::new().find("simtest1", &[]).unwrap();
    let mut replay = match Replay::open(&path, &scene) {
        Ok(replay) => replay,
        Err(error) => return error,
    };
    loop {
        match replay.next_frame() {
            Ok(Some(_)) => {}
            Ok(None) => panic!("nothing was refused"),
            Err(error) => return error,
        }
    }
}

#[test]
fn broken_tables_are_refused_by_the_line() {
    const HEADER: &str = "t,ball,x,y,z,vx,vy,vz";
    const GOOD: &str = "0.02,0,1,2,3,4,5,6";
    let problem = |rows: &[&str], line: u64| match refusal(HEADER, rows) {
        ReplayError::Line { line: found, problem, .. } => {
            assert_eq!(found, line, "{problem}");
            problem
        }
        error => panic!("{error}"),
    };
    let found = problem(&[GOOD, "0.04,0,1,two,3,4,5,6"], 3);
    assert!(matches!(found, LineProblem::NotANumber { column: "y", text } if text == "two"));
    let found = problem(&["0.02,0,1,2,3,4,5,NaN"], 2);
    assert!(matches!(found, LineProblem::NotANumber { column: "vz", .. }));
    let found = problem(&["0.02,-1,1,2,3,4,5,6"], 2);
    assert!(matches!(found, LineProblem::NotANumber { column: "ball", .. }));
    let found = problem(&[GOOD, "0.04,0,1,2,3"], 3);
    assert!(matches!(found, LineProblem::Fields { fields: 5, expected: 8 }));
    let found = problem(&["0.04,0,1,2,3,4,5,6", GOOD], 3);
    assert!(matches!(found, LineProblem::TimeGoesBack { time: 0.02, last: 0.04 }));
    let found = problem(&[GOOD, GOOD], 3);
    assert!(matches!(found, LineProblem::Order { ball: 0, last: 0 }));
    for ball in ["7", "12345678901234", "18446744073709551615"] {
        let found = problem(&[GOOD, &format!("0.04,{ball},1,2,3,4,5,6")], 3);
        assert!(matches!(found, LineProblem::UnknownBall { time: 0.04, .. }), "{found}");
    }
    // A huge time does not take long, either.
    assert!(matches!(problem(&["1e300,0,1,2,3,4,5,6", GOOD], 3), LineProblem::TimeGoesBack { .. }));
    let found = refusal("t,ball,x,y,z,vx,vy", &["0.02,0,1,2,3,4,5"]);
    assert!(matches!(found, ReplayError::MissingColumn { column: "vz", .. }));
}

#[test]
fn a_recording_of_another_scene_is_refused_by_where_its_balls_start() {
    let folder = tempfile::tempdir().unwrap();
    let names = ["billiards", "cradle", "tutorial1", "tutorial2", "gas"];
    for name in names {
        let path = folder.path().join(name).with_extension("csv");
        record(&scene(name, Rule::Exact), 2, 1, &path);
        for other in names {
            let mut replay = Replay::open(&path, &scene(other, Rule::Exact)).unwrap();
            let refused = match replay.next_frame() {
                Ok(_) => false,
                Err(ReplayError::Line { problem, .. }) => matches!(
                    problem,
                    LineProblem::Elsewhere { .. } | LineProblem::UnknownBall { .. }
                ),
                Err(error) => panic!("{error}"),
            };
            assert_eq!(refused, name != other, "{name} as {other}");
        }
    }
}

#[test]
fn what_is_no_rotation_is_refused_by_the_line() {
    const HEADER: &str = "t,ball,x,y,z,vx,vy,vz,qx,qy,qz,qw";
    let problem = |rotation: &str| {
        let row = format!("0.02,0,1,2,3,4,5,6,{rotation}");
        match refusal(HEADER, &[&row]) {
            ReplayError::Line { line: 2, problem, .. } => problem,
            error => panic!("{error}"),
        }
    };
    assert!(matches!(problem("0,0,0,0"), LineProblem::NotARotation(it) if it == [0.0; 4]));
    // The length of this quaternion overflows.
    assert!(matches!(problem("0,0,0,1e300"), LineProblem::NotARotation(_)));
    assert!(matches!(problem("0,0,?,1"), LineProblem::NotANumber { column: "qz", .. }));
    let found = refusal("t,ball,x,y,z,vx,vy,vz,qx,qy,qw", &["0.02,0,1,2,3,4,5,6,0,0,1"]);
    assert!(matches!(found, ReplayError::MissingColumn { column: "qz", .. }));
}

#[test]
fn a_rotation_may_have_any_length() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(FILE);
    let text = "t,ball,x,y,z,vx,vy,vz,qx,qy,qz,qw\n0.02,0,1,2,3,4,5,6,0,3,0,4\n";
    std::fs::write(&path, text).unwrap();
    let (scene, _) = Library::new().find("simtest1", &[]).unwrap();
    let frame = Replay::open(&path, &scene).unwrap().next_frame().unwrap().unwrap();
    let found = frame.balls[0].orientation.unwrap().to_array();
    // One or two rounding errors of numbers up to 1.
    [0.0, 0.6, 0.0, 0.8].iter().zip(found).for_each(|(a, b)| assert!((a - b).abs() < 1e-15));
}

#[test]
fn a_file_that_is_not_there_is_named() {
    let (scene, _) = Library::new().find("simtest1", &[]).unwrap();
    let error = Replay::open(Path::new("no/such.csv"), &scene).unwrap_err().to_string();
    assert!(error.starts_with("cannot read no/such.csv: "), "{error}");
}

#[test]
fn columns_may_stand_in_any_order_beside_others() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(FILE);
    std::fs::write(&path, "note,vz,vy,vx,z,y,x,ball,t\r\nhello,6,5,4,3,2,1,0,0.02\r\n").unwrap();
    let (scene, _) = Library::new().find("simtest1", &[]).unwrap();
    let frame = Replay::open(&path, &scene).unwrap().next_frame().unwrap().unwrap();
    assert_eq!(frame.balls[0].position.to_array(), [1.0, 2.0, 3.0]);
    assert_eq!(frame.balls[0].velocity.to_array(), [4.0, 5.0, 6.0]);
}
