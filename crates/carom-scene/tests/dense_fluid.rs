//! Dense fluids of scene files: they overlap nothing, have the temperature and the pressure of a fluid in
//! equilibrium, and are the same at every size; errors name line and field.

use carom::packing::{equilibrate, packing_fraction};
use carom_scene::Scene;

fn read(text: &str) -> Scene {
    Scene::from_toml(&format!("name = 'test'\n{text}"), "test.toml").unwrap()
}

fn refusal(text: &str) -> String {
    Scene::from_toml(&format!("name = 'test'\n{text}"), "test.toml").unwrap_err().to_string()
}

const PERIODIC: &str = "simulation = { boundary = { periodic = { size = [9, 8, 7] } } }\n\
                        [[generators]]\n[generators.dense-fluid]\ncount = 400\n\
                        temperature = 2.0\nseed = 7\npacking_fraction = 0.45\n\
                        sphere = { mass = 3, restitution = 0.9 }\n";

const WALLS: &str = "[[generators]]\n[generators.dense-fluid]\ncount = 300\ntemperature = 0.5\nseed = 1\n\
                     radius_range = [0.2, 0.5]\nmin = [-1, 0, 2]\nmax = [4, 6, 7]\n\
                     sphere = { density = 2, velocity = [0, 0, 1] }\n";

/// k T of the spheres of a world that moves with a velocity of `drift` along z \[J\].
fn temperature(world: &carom::World, drift: f64) -> f64 {
    let spheres = world.spheres();
    let square = |v: &carom::DVec3| (*v - drift * carom::DVec3::Z).length_squared();
    let sum: f64 =
        spheres.masses().iter().zip(spheres.velocities()).map(|(m, v)| m * square(v)).sum();
    sum / (3.0 * spheres.len() as f64)
}

#[test]
fn a_fluid_fills_the_periodic_box_at_its_packing_fraction_and_temperature() {
    let world = read(PERIODIC).world().unwrap();
    assert_eq!(world.spheres().len(), 400);
    assert!(world.overlaps(0.0).is_empty());
    // Radii follow from the fraction by one cube root.
    assert!((packing_fraction(&world, None).unwrap() - 0.45).abs() < 1e-14);
    // A sum of 400 squares, rounded.
    assert!((temperature(&world, 0.0) - 2.0).abs() < 1e-12);
    assert!(world.spheres().restitutions().iter().all(|&e| e == 0.9));
    let momentum = world.momentum().length();
    // Impacts conserve it to rounding: 400 times 3 kg times 1 m/s times 1e-16, some thousand times.
    assert!(momentum < 1e-9, "{momentum}");
}

#[test]
fn a_fluid_presses_as_carnahan_and_starling_say() {
    let text = PERIODIC.replace("restitution = 0.9", "restitution = 1");
    let mut world = read(&text).world().unwrap();
    let measured = equilibrate(&mut world, 200.0, None).unwrap().pressure;
    let p: f64 = 0.45;
    let expected = (1.0 + p + p * p - p * p * p) / (1.0 - p).powi(3);
    // 40,000 collisions scatter by half a per cent; 400 spheres differ from many by as much.
    assert!((measured / expected - 1.0).abs() < 0.015, "{measured} instead of {expected}");
}

#[test]
fn a_fluid_within_walls_lies_between_its_corners() {
    let world = read(WALLS).world().unwrap();
    let spheres = world.spheres();
    assert!(world.overlaps(0.0).is_empty());
    for (&center, &radius) in spheres.positions().iter().zip(spheres.radii()) {
        assert!((0.2..=0.5).contains(&radius));
        assert!((center - radius).cmpge(carom::DVec3::new(-1.0, 0.0, 2.0)).all());
        assert!((center + radius).cmple(carom::DVec3::new(4.0, 6.0, 7.0)).all());
    }
    assert!(
        spheres.radii().iter().any(|&it| it < 0.25) && spheres.radii().iter().any(|&it| it > 0.45)
    );
    // A sum of 300 squares, rounded.
    assert!((temperature(&world, 1.0) - 0.5).abs() < 1e-12);
}

#[test]
fn a_fluid_repeats_by_its_seed_and_comes_back_expanded() {
    for text in [PERIODIC, WALLS] {
        let scene = read(text);
        let hash = |scene: &Scene| scene.world().unwrap().state_hash();
        assert_eq!(hash(&scene), hash(&read(text)));
        assert_eq!(hash(&scene), hash(&scene.expanded().unwrap()));
        assert_eq!(Scene::from_toml(&scene.to_toml(), "again").unwrap(), scene);
        let other = read(&text.replace("seed = ", "seed = 1"));
        assert_ne!(hash(&scene), hash(&other));
    }
}

#[test]
fn a_fluid_is_the_same_at_a_millionth_and_a_million_times_its_size() {
    let positions = |scale: f64| {
        let corner = |at: [f64; 3]| format!("{:?}", at.map(|it| scale * it));
        let text = WALLS
            .replace("[-1, 0, 2]", &corner([-1.0, 0.0, 2.0]))
            .replace("[4, 6, 7]", &corner([4.0, 6.0, 7.0]))
            .replace("[0.2, 0.5]", &format!("{:?}", [0.2 * scale, 0.5 * scale]))
            .replace("count = 300", "count = 60");
        read(&text).world().unwrap().spheres().positions().to_vec()
    };
    let usual = positions(1.0);
    // Powers of two round nothing; the velocities of growth are 1 m/s in all.
    for scale in [2f64.powi(-20), 2f64.powi(20)] {
        let scaled = positions(scale);
        let error = |(one, other): (&carom::DVec3, &carom::DVec3)| one.distance(*other / scale);
        let worst = usual.iter().zip(&scaled).map(error).fold(0.0, f64::max);
        assert!(worst < 1e-12, "{worst} m at {scale}");
    }
}

#[test]
fn few_spheres_are_fluids_too() {
    for count in [1, 2, 3] {
        let text = PERIODIC.replace("count = 400", &format!("count = {count}"));
        let text = text.replace("packing_fraction = 0.45", "packing_fraction = 0.001");
        let world = read(&text).world().unwrap();
        assert_eq!(world.spheres().len(), count);
        assert!((packing_fraction(&world, None).unwrap() - 0.001).abs() < 1e-15);
    }
}

#[test]
fn what_makes_no_fluid_is_refused_by_line_and_field() {
    let cases = [
        (
            PERIODIC,
            "packing_fraction = 0.45",
            "packing_fraction = 1.5",
            "8: generators[0].dense-fluid.packing_fraction: must be between 0 and 1",
        ),
        (
            PERIODIC,
            "packing_fraction = 0.45",
            "packing_fraction = 0.8",
            "8: generators[0].dense-fluid.packing_fraction: asks for 0.8000 of the box, but the spheres jam at 0.6",
        ),
        (
            PERIODIC,
            "mass = 3",
            "mass = 3, radius = 1",
            "8: generators[0].dense-fluid.packing_fraction: must not be given beside a radius",
        ),
        (
            PERIODIC,
            "packing_fraction = 0.45",
            "",
            "generators[0].dense-fluid.sphere: needs `radius`",
        ),
        (
            PERIODIC,
            "temperature = 2.0",
            "temperature = -1.0",
            "6: generators[0].dense-fluid.temperature: must be zero or positive",
        ),
        (
            PERIODIC,
            "count = 400",
            "count = 0",
            "5: generators[0].dense-fluid.count: must make 1 to 100000 spheres",
        ),
        (
            PERIODIC,
            "count = 400",
            "count = 100001",
            "5: generators[0].dense-fluid.count: must make 1 to 100000 spheres",
        ),
        (
            PERIODIC,
            "[9, 8, 7]",
            "[9, 8, inf]",
            "simulation.boundary.periodic.size: must be finite along every axis",
        ),
        (
            PERIODIC,
            "simulation = { boundary = { periodic = { size = [9, 8, 7] } } }",
            "",
            "generators[0].dense-fluid: needs `min` and `max`",
        ),
        (
            PERIODIC,
            "mass = 3",
            "mass = -3",
            "generators[0].dense-fluid.sphere.mass: must be positive",
        ),
        (WALLS, "max = [4, 6, 7]", "", "generators[0].dense-fluid: needs both `min` and `max`"),
        (
            WALLS,
            "max = [4, 6, 7]",
            "max = [4, -6, 7]",
            "generators[0].dense-fluid.max: must be above `min`",
        ),
        (
            WALLS,
            "max = [4, 6, 7]",
            "max = [4, 0.5, 7]",
            "generators[0].dense-fluid.count: must leave room",
        ),
    ];
    for (text, from, to, expected) in cases {
        let said = refusal(&text.replacen(from, to, 1));
        assert!(said.contains(expected), "{said}\ninstead of {expected}");
    }
}
