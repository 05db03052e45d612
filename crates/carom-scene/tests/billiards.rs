//! Strikes and pockets of scene files, and the tables of scenes.

use carom::{DVec3, QueryFilter, SphereTangent, Tangents, Tape, Variation, World};
use carom_scene::{Library, Scene};

const TEXT: &str = "name = 'shot'
[[spheres]]
radius = '28.575 mm'
mass = 0.17
strike = { speed = '2 m/s', azimuth_degrees = 90, offset = [0.2, 0.3] }

[[colliders]]
shape = { sphere = { radius = 0.03 } }
position = [1, 0, 0]
trigger = true
capture = true
";

fn read(text: &str) -> Scene {
    Scene::from_toml(text, "shot.toml").unwrap()
}

#[test]
fn strike_sets_the_ball_in_motion_and_is_written_again() {
    let scene = read(TEXT);
    let world = scene.world().unwrap();
    let (velocity, spin) =
        (world.spheres().velocities()[0], world.spheres().angular_velocities()[0]);
    // Counterclockwise from above: from +x to -z. The spin is 5/2 of the offset, as a part of `v/R`.
    let speed = 2.0 * 2.0 / (1.0 + 0.17 / 0.567 + 2.5 * (0.2 * 0.2 + 0.3 * 0.3));
    assert!((velocity - carom::DVec3::new(0.0, 0.0, -speed)).length() < 1e-15, "{velocity}");
    let turning = 2.5 * speed / 0.028575;
    // Up for English on the right, along -x for topspin.
    let expected = carom::DVec3::new(-0.3 * turning, 0.2 * turning, 0.0);
    assert!((spin - expected).length() < 1e-12, "{spin} {expected}");
    assert!(world.colliders().next().unwrap().1.captures);
    assert_eq!(read(&scene.to_toml()), scene);
}

#[test]
fn wrong_strikes_and_pockets_are_refused_with_their_line() {
    let expect = |from: &str, to: &str, parts: [&str; 2]| {
        assert!(TEXT.contains(from));
        let said = match Scene::from_toml(&TEXT.replace(from, to), "shot.toml") {
            Ok(scene) => scene.world().unwrap_err().to_string(),
            Err(error) => error.to_string(),
        };
        assert!(parts.iter().all(|part| said.contains(part)), "{said}");
        assert!(!said.contains("decimals"), "{said}");
    };
    let strike = "shot.toml:5";
    expect("'2 m/s'", "-2", [strike, "spheres[0].strike.speed"]);
    expect("'2 m/s'", "'2 m'", [strike, "not in m/s"]);
    expect("'2 m/s'", "1e200", [strike, "spheres[0].strike.speed"]);
    expect("[0.2, 0.3]", "[0.2, 0.3, 0]", ["strike.offset: 3 values are too many", strike]);
    expect("speed = '2 m/s', ", "", [strike, "speed"]);
    expect("offset = [0.2, 0.3]", "offset = [0.6, 0.8]", [strike, "spheres[0].strike.offset"]);
    expect("= 90", "= inf", [strike, "spheres[0].strike.azimuth_degrees"]);
    expect("offset = [0.2, 0.3]", "elevation_degrees = 91", [strike, "elevation_degrees"]);
    expect("offset = [0.2, 0.3]", "cue_mass = 0", [strike, "spheres[0].strike.cue_mass"]);
    expect("offset", "ofset", [strike, "offset"]);
    expect("trigger = true\n", "", ["shot.toml:10", "colliders[0].capture"]);
}

/// A break in which no ball leaves the table but through pockets, and the account of energy closes.
#[test]
fn nine_balls_stay_on_the_table_until_they_fall_into_pockets() {
    let (scene, _) = Library::new().find("nine-ball", &[]).unwrap();
    let mut world = scene.world().unwrap();
    let before = world.total_energy();
    let (mut account, mut fallen) = (0.0, Vec::new());
    for _ in 0..720 {
        let report = world.step(scene.simulation.frame_time).unwrap();
        account += report.energy_account.total();
        fallen.extend(report.retired.iter().copied());
    }
    for place in world.spheres().positions() {
        let [x, z] = [place.x.abs(), place.z.abs()];
        assert!(x < 1.38 && z < 0.745 && (place.y - 0.028575).abs() < 1e-6, "{place}");
    }
    assert_eq!(world.spheres().len() + fallen.len(), 10);
    assert!(!fallen.is_empty());
    // Rounding of the energy of the cue ball.
    let off = world.total_energy() - before - account;
    assert!(off.abs() < 1e-12 * before, "{off} of {before}");
}

#[test]
fn the_strike_that_descent_found_stops_the_object_ball_on_the_mark() {
    let (scene, _) = Library::new().find("bank-shot", &[]).unwrap();
    let mut world = scene.world().unwrap();
    let mut tape = Tape::start(&world).unwrap();
    for _ in 0..480 {
        tape.step(&mut world, scene.simulation.frame_time).unwrap();
    }
    // The cushion, then the ball.
    assert_eq!(tape.impacts(), 2);
    let mark = DVec3::new(1.1, 0.028575, -0.2);
    let off = world.spheres().positions()[1] - mark;
    assert!(off.length() < 1e-12, "{off}");
    // So no small change of the strike brings it nearer.
    let miss = SphereTangent { position: off, ..SphereTangent::default() };
    let [struck, object] = [0, 1].map(|place| world.spheres().ids()[place]);
    let slope = tape.gradient(&[(object, miss)]).unwrap().sphere(struck).velocity;
    assert!(slope.length() < 1e-11, "{slope}");
}

/// How far each ball of the right table of `butterfly` is from its place on the left table.
fn apart(world: &World) -> Vec<DVec3> {
    let (left, right) = world.spheres().positions().split_at(16);
    left.iter()
        .zip(right)
        .map(|(left, right)| *right - *left - DVec3::new(1.36, 0.0, 0.0))
        .collect()
}

#[test]
fn two_breaks_part_as_the_derivative_says_until_nothing_is_alike() {
    let (scene, _) = Library::new().find("butterfly", &[]).unwrap();
    let mut world = scene.world().unwrap();
    let before = world.total_energy();
    let aside = Variation::default().with_position(world.spheres().ids()[16], DVec3::X);
    let mut tangents = Tangents::new(&world, vec![aside]).unwrap();
    let largest = |all: &[DVec3]| all.iter().map(|it| it.length()).fold(0.0, f64::max);
    let mut compared = 0;
    for _ in 0..300 {
        let apart = apart(&world);
        let off: Vec<DVec3> = apart
            .iter()
            .zip(&tangents.spheres(0)[16..])
            .map(|(apart, tangent)| *apart - 1e-9 * tangent.position)
            .collect();
        let distance = largest(&apart);
        if distance < 1e-6 {
            // A nanometre beside 0.7 m has seven digits. An impact turns by the distance over the radius.
            let bound = 1e-6 + 3.0 * distance / 0.028575;
            assert!(largest(&off) < bound * distance, "{} of {distance}", largest(&off));
            compared += 1;
        }
        tangents.step(&mut world, scene.simulation.frame_time).unwrap();
    }
    assert!(compared > 100, "{compared}");
    assert!(largest(&apart(&world)) > 0.1);
    assert!((world.total_energy() - before).abs() < 1e-14 * before);
}

#[test]
fn no_ground_is_seen_between_the_cloth_and_the_rails() {
    let (scene, _) = Library::new().find("billiards", &[]).unwrap();
    let world = scene.world().unwrap();
    let queries = world.queries();
    let filter = QueryFilter::DEFAULT.with_spheres(false);
    // The outer edges of the rails, and how far the table reaches down.
    let (half, bottom) = (DVec3::new(1.43, 0.0, 0.795), -0.11);
    for column in 0..=400 {
        for row in 0..=200 {
            let part = DVec3::new(column as f64 / 200.0 - 1.0, 0.0, row as f64 / 100.0 - 1.0);
            // Not on the edge itself, which rounding may miss.
            let place = 0.999 * half * part;
            let hit = queries.cast_ray(place + DVec3::Y, -2.0 * DVec3::Y, &filter).unwrap();
            assert!(hit.is_some_and(|it| it.point.y > bottom), "{place}: {hit:?}");
        }
    }
}
