//! Springs and fields of scene files: the world that they create, and errors with their places.

use carom::SpringEnd;
use carom_scene::Scene;

const BALLS: &str = r#"
name = "springs"
spheres = [{ radius = 0.1 }, { position = [0.0, 3.0, 4.0], radius = 0.1 }]
[[generators]]
row = { count = 4, start = [1.0, 0.0, 0.0], step = [1.0, 0.0, 0.0], sphere = { radius = 0.1 } }
"#;

fn scene(springs: &str) -> Result<Scene, String> {
    Scene::from_toml(&format!("{BALLS}{springs}"), "springs.toml").map_err(|it| it.to_string())
}

#[test]
fn springs_name_single_spheres_first_and_then_those_of_generators() {
    let text = r#"
        [[springs]]
        spheres = [0, 1]
        stiffness = "2 kN/m"
        [[springs]]
        sphere = 2
        anchor = [1.0, 2.0, 0.0]
        rest_length = "50 cm"
        stiffness = 1.0
        damping = 0.5
        only_pulls = true
        [[springs]]
        chain = [2, 5]
        stiffness = 3.0
    "#;
    let scene = scene(text).unwrap();
    let world = scene.world().unwrap();
    let springs: Vec<_> = world.springs().map(|(_, spring)| *spring).collect();
    let ids = world.spheres().ids();
    assert_eq!(springs.len(), 5);
    // The distance at the start: a triangle of sides 3, 4, 5.
    assert_eq!((springs[0].rest_length, springs[0].stiffness), (5.0, 2000.0));
    assert_eq!(springs[1].to, SpringEnd::Point(carom::DVec3::new(1.0, 2.0, 0.0)));
    assert_eq!((springs[1].rest_length, springs[1].damping), (0.5, 0.5));
    assert!(springs[1].only_pulls && !springs[0].only_pulls);
    for (i, spring) in springs[2..].iter().enumerate() {
        assert_eq!((spring.sphere, spring.to), (ids[2 + i], SpringEnd::Sphere(ids[3 + i])));
        assert_eq!(spring.rest_length, 1.0);
    }
    let again = Scene::from_toml(&scene.to_toml(), "again").unwrap();
    assert_eq!(again, scene);
}

#[test]
fn springs_that_make_no_sense_are_refused_by_line_and_field() {
    for (spring, message) in [
        ("spheres = [0, 6]\nstiffness = 1.0", "springs[0].spheres: there is no sphere 6: spheres"),
        ("spheres = [1, 1]\nstiffness = 1.0", "springs[0].spheres: must be two spheres"),
        ("sphere = 0\nstiffness = 1.0", "springs[0]: needs `spheres`"),
        ("chain = [3, 3]\nstiffness = 1.0", "springs[0].chain: must be the first sphere"),
        ("chain = [0, 9]\nstiffness = 1.0", "springs[0].chain: there is no sphere 9"),
        ("spheres = [0, 1]\nstiffness = -1.0", "springs[0].stiffness: must be zero or positive"),
        ("sphere = 0\nanchor = [nan, 0.0, 0.0]\nstiffness = 1.0", "springs[0].anchor: must be"),
        ("spheres = [0, 1]\nstiffness = \"1 kg\"", "springs[0].stiffness: \"1 kg\" is in kg"),
        ("spheres = [0, 1]\nstifness = 1.0", "did you mean \"stiffness\""),
    ] {
        let error = scene(&format!("[[springs]]\n{spring}")).unwrap_err();
        assert!(error.starts_with("springs.toml:") && error.contains(message), "{error}");
    }
}

#[test]
fn every_kind_of_force_is_read_and_written() {
    let forces = r#"
        name = "forces"
        [[forces]]
        point-attractor = { gravitational_parameter = 2.0 }
        [[forces]]
        mutual-gravity = {}
        [[forces]]
        wind = { velocity = [1.0, 0.0, 0.0], coefficient = 0.5 }
        [[forces]]
        vortex = { circulation = 3.0, core_radius = "20 cm", coefficient = 0.5 }
        [[forces]]
        quadratic-drag = { density = 1.2, viscosity = "0.018 mPa s" }
        [[forces]]
        buoyancy = { density = 1000.0 }
    "#;
    let scene = Scene::from_toml(forces, "forces.toml").unwrap();
    assert_eq!(Scene::from_toml(&scene.to_toml(), "again").unwrap(), scene);
    let world = scene.world().unwrap();
    let expected = [
        format!("{:?}", carom::PointAttractor::new(carom::DVec3::ZERO, 2.0)),
        format!("{:?}", carom::MutualGravity::new(carom::MutualGravity::NEWTON)),
        format!("{:?}", carom::Wind::new(carom::DVec3::X, 0.5)),
        format!("{:?}", carom::Vortex::new(carom::DVec3::ZERO, 3.0, 0.5).with_core_radius(0.2)),
        format!("{:?}", carom::QuadraticDrag::new(1.2).with_viscosity(0.018 / 1e3)),
        format!("{:?}", carom::Buoyancy::new(1000.0, 0.0)),
    ];
    let found: Vec<_> = world.forces().map(|(_, force)| format!("{force:?}")).collect();
    assert_eq!(found, expected);
}
