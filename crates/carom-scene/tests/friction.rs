//! Friction, rotation and the rule `contact` in scene files: every field reaches the world and is
//! written back.

use carom::{CombineRule, Contact, DQuat, DVec3, Friction, Rule};
use carom_scene::Scene;
use carom_scene::scene::Sphere;

/// A scene with every field of friction and rotation, in every table that has it.
const TURNING: &str = r#"
name = "turning"

[simulation]
rule = "contact"
combine_rule = "geometric-mean"
friction_combine_rule = "minimum"
contact = { sub_steps = 5, sweeps = 3, converged = true }

[[spheres]]
position = [0, 1, 0]
radius = 0.5
friction = 0.3
rolling_friction = 0.01
spinning_friction = 0.02
tangential_restitution = 0.4
orientation = [0, 0.6, 0, 0.8]
angular_velocity = [1, 2, 3]
inertia_factor = 0.5

[[generators]]
[generators.row]
count = 2
start = [0, 5, 0]
step = [2, 0, 0]
sphere = { radius = 0.5, friction = 0.7, angular_velocity = [0, 0, 9] }

[[colliders]]
shape = "half-space"
friction = 0.6
rolling_friction = 0.05
spinning_friction = 0.06
tangential_restitution = 0.07

[[emitters]]
position = [0, 20, 0]
period = 1.0
sphere = { radius = 0.1, friction = 0.2, inertia_factor = 0.6 }
"#;

fn read(text: &str) -> Scene {
    Scene::from_toml(text, "turning.toml").unwrap()
}

/// Friction with all four coefficients.
fn friction([sliding, rolling, spinning, tangential_restitution]: [f64; 4]) -> Friction {
    Friction::sliding(sliding)
        .with_rolling(rolling)
        .with_spinning(spinning)
        .with_tangential_restitution(tangential_restitution)
}

#[test]
fn every_field_reaches_the_world() {
    let world = read(TURNING).world().unwrap();
    let settings = world.settings();
    let contact = Contact::default().with_sub_steps(5).with_sweeps(3).with_converged(true);
    assert_eq!(settings.rule, Rule::Contact(contact));
    assert_eq!(settings.combine_rule, CombineRule::GeometricMean);
    assert_eq!(settings.friction_combine_rule, CombineRule::Minimum);
    let first = world.spheres().get(0);
    assert_eq!(first.friction, friction([0.3, 0.01, 0.02, 0.4]));
    assert_eq!(first.orientation, DQuat::from_xyzw(0.0, 0.6, 0.0, 0.8).normalize());
    assert_eq!(first.angular_velocity, DVec3::new(1.0, 2.0, 3.0));
    assert_eq!(first.inertia_factor, 0.5);
    let generated = world.spheres().get(2);
    assert_eq!(generated.friction, Friction::sliding(0.7));
    assert_eq!(generated.angular_velocity, DVec3::new(0.0, 0.0, 9.0));
    let collider = world.colliders().next().unwrap().1;
    assert_eq!(collider.friction, friction([0.6, 0.05, 0.06, 0.07]));
    let emitted = world.emitters().next().unwrap().1.sphere;
    assert_eq!((emitted.friction, emitted.inertia_factor), (Friction::sliding(0.2), 0.6));
}

#[test]
fn a_scene_comes_back_from_its_text_and_spheres_from_the_world() {
    let scene = read(TURNING);
    assert_eq!(read(&scene.to_toml()), scene);
    let world = scene.world().unwrap();
    for index in 0..world.spheres().len() {
        let sphere = world.spheres().get(index);
        let mut written = Scene::new("written");
        written.spheres = vec![Sphere::of(&sphere)];
        let again = read(&written.to_toml()).world().unwrap();
        assert_eq!(again.spheres().get(0), sphere);
    }
}

/// Files without friction and rotation are written without these fields.
#[test]
fn what_says_nothing_of_friction_and_rotation_is_written_without_them() {
    let scene = read(
        "name = 'plain'\nspheres = [{ radius = 1.0, position = [0, 2, 0] }]\n\
         [[colliders]]\nshape = 'half-space'\n",
    );
    let text = scene.to_toml();
    let words = ["friction", "tangential", "orientation", "angular", "inertia", "contact]"];
    assert!(words.iter().all(|word| !text.contains(word)), "{text}");
}
