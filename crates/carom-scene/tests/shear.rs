//! Steady shear of the periodic box of scene files: what is read, written, and refused.

use carom_scene::Palette;
use carom_scene::scene::Scene;

const SHEARED: &str = r#"
name = "sheared"
[simulation]
boundary = { periodic = { size = [4.0, 4.0, 4.0], shear_rate = 0.25 } }
[[spheres]]
radius = 0.5
velocity = [0.0, 1.0, 0.0]
"#;

#[test]
fn a_box_in_shear_is_the_same_after_it_was_written_and_read() {
    let scene = Scene::from_toml(SHEARED, "sheared.toml").unwrap();
    assert_eq!(scene.settings().shear_rate, 0.25);
    assert_eq!(Scene::from_toml(&scene.to_toml(), "sheared.toml").unwrap(), scene);
    let mut world = scene.world().unwrap();
    world.step(3.0).unwrap();
    // Through the face above at 2 s, into the box that has slid by 3 m at 3 s.
    assert_eq!(world.spheres().positions()[0].to_array(), [1.0, -1.0, 0.0]);
}

#[test]
fn rough_balls_in_shear_move_under_the_rule_contact() {
    let rough =
        SHEARED.replace("radius", "friction = 0.5\nangular_velocity = [1.0, 0.0, 0.0]\nradius");
    let text = rough.replace("[simulation]", "[simulation]\nrule = \"contact\"");
    let scene = Scene::from_toml(&text, "sheared.toml").unwrap();
    assert_eq!(Scene::from_toml(&scene.to_toml(), "sheared.toml").unwrap(), scene);
    let mut world = scene.world().unwrap();
    world.step(3.0).unwrap();
    let place = world.spheres().positions()[0];
    // Of the eight and more sub-steps of a frame each rounds.
    assert!((place - carom::DVec3::new(1.0, -1.0, 0.0)).length() < 1e-13, "{place}");
}

#[test]
fn balls_in_shear_have_colours() {
    let scene = Scene::from_toml(SHEARED, "sheared.toml").unwrap();
    assert!(Palette::new(&scene).is_ok());
}

#[test]
fn shear_that_makes_no_sense_is_refused_with_its_place() {
    for (text, with, what) in [
        ("[4.0, 4.0, 4.0]", "[4.0, inf, 4.0]", "finite edges along x and y"),
        ("radius", "friction = 0.5\nradius", "zero where friction acts"),
    ] {
        let text = SHEARED.replace(text, with);
        let error = Scene::from_toml(&text, "sheared.toml").unwrap_err().to_string();
        assert!(error.contains("shear_rate") && error.contains(what), "{error}");
    }
}

/// Grains of a lattice and one far above the box, at two sizes of everything.
#[test]
fn velocities_relative_to_the_flow_get_its_own_added_wherever_spheres_come_from() {
    for size in [libm::ldexp(1.0, -20), 1.0, libm::ldexp(1.0, 20)] {
        let text = format!(
            r#"
name = "sheared"
[simulation]
boundary = {{ periodic = {{ size = [{0}, {0}, {0}], shear_rate = 0.25, relative_velocities = true }} }}
[[spheres]]
position = [0.0, {1}, 0.0]
radius = {2}
velocity = [0.0, 0.0, {2}]
[[generators]]
[generators.lattice]
counts = [1, 2, 1]
start = [{2}, {2}, {2}]
spacing = [{2}, {2}, {2}]
sphere = {{ radius = {3} }}
"#,
            4.0 * size,
            5.0 * size,
            0.5 * size,
            0.125 * size
        );
        let scene = Scene::from_toml(&text, "sheared.toml").unwrap();
        assert_eq!(Scene::from_toml(&scene.to_toml(), "sheared.toml").unwrap(), scene);
        let mut world = scene.world().unwrap();
        let along =
            |world: &carom::World, index: usize| world.spheres().velocities()[index].x / size;
        assert_eq!([0, 1, 2].map(|index| along(&world, index)), [1.25, 0.125, 0.25]);
        world.step(0.125).unwrap();
        // It is in the box now, where its image moves with the flow, too.
        assert_eq!([0, 1, 2].map(|index| along(&world, index)), [0.25, 0.125, 0.25]);
        assert_eq!(world.spheres().velocities()[0].z, 0.5 * size);
    }
}

#[test]
fn velocities_are_as_written_where_nothing_is_sheared() {
    let text = SHEARED.replace("shear_rate = 0.25", "relative_velocities = true");
    let world = Scene::from_toml(&text, "still.toml").unwrap().world().unwrap();
    assert_eq!(world.spheres().velocities()[0].to_array(), [0.0, 1.0, 0.0]);
}
