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
