//! Square wells and growth of scene files: what is read, written, and refused.

use carom_scene::scene::{PairPotential, Scene};

fn scene(simulation: &str, sphere: &str) -> String {
    format!(
        "name = \"gas\"\n[simulation]\n{simulation}\n\
         boundary = {{ periodic = {{ size = [4.0, 4.0, 4.0] }} }}\n\
         [[spheres]]\nposition = [-1.0, 0.0, 0.0]\nradius = 0.5\nvelocity = [1.0, 0.0, 0.0]\n{sphere}\n\
         [[spheres]]\nposition = [0.75, 0.0, 0.0]\nradius = 0.5\n"
    )
}

fn read(text: &str) -> Result<Scene, String> {
    Scene::from_toml(text, "gas.toml").map_err(|error| error.to_string())
}

#[test]
fn wells_are_the_same_after_they_were_written_and_read() {
    let text = "pair_potential = { square-well = { depth = \"0.5 J\", range_ratio = 1.5 } }";
    let scene = read(&scene(text, "")).unwrap();
    let expected = PairPotential::SquareWell { depth: 0.5, range_ratio: 1.5 };
    assert_eq!(scene.simulation.pair_potential, Some(expected));
    assert_eq!(read(&scene.to_toml()).unwrap(), scene);
    let mut world = scene.world().unwrap();
    // The second one is 1.75 m from the first one and 2.25 m from its image: they meet at 1.5 m after 0.25 s.
    world.step(0.3).unwrap();
    assert_eq!(world.potential_energy(), -0.5);
    assert!((world.kinetic_energy() - 1.0).abs() < 1e-14);
}

#[test]
fn wells_that_make_no_sense_are_refused_with_their_line() {
    for (text, field) in [
        ("square-well = { depth = 1.0, range_ratio = 1.0 }", "range_ratio"),
        ("square-well = { depth = inf, range_ratio = 1.5 }", "depth"),
        ("square-well = { depth = 1.0 }", "range_ratio"),
    ] {
        let error = read(&scene(&format!("pair_potential = {{ {text} }}"), "")).unwrap_err();
        assert!(error.contains("gas.toml:3") && error.contains(field), "{error}");
    }
    let well = "pair_potential = { square-well = { depth = 1.0, range_ratio = 1.5 } }";
    let error = read(&scene(&format!("rule = \"contact\"\n{well}"), "")).unwrap_err();
    assert!(
        error
            .contains("simulation.pair_potential: must be left out under rules other than `exact`"),
        "{error}"
    );
}

#[test]
fn balls_grow_at_the_speed_of_their_scene() {
    let scene = read(&scene("", "growth_speed = \"0.25 m/s\"")).unwrap();
    assert_eq!(scene.spheres[0].growth_speed, 0.25);
    assert_eq!(read(&scene.to_toml()).unwrap(), scene);
    let mut world = scene.world().unwrap();
    world.step(0.5).unwrap();
    assert_eq!(world.spheres().radii(), [0.625, 0.5]);
    // The sum of the radii grows, and the first one comes nearer: 0.75 m at 1.25 m/s.
    let report = world.step(0.125).unwrap();
    assert!((report.impacts[0].time - 0.1).abs() < 1e-15);
    let error = read(&self::scene("", "growth_speed = -1.0")).unwrap_err();
    assert!(error.contains("growth_speed"), "{error}");
}
