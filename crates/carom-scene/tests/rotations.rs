//! Rotations in every form that scene files allow.

use carom::{DQuat, DVec3};
use carom_scene::Scene;

/// Rounding error of about ten operations, half an epsilon each.
const ROUND_OFF: f64 = 1e-15;

fn scene(rotation: &str) -> Result<Scene, String> {
    let text = format!(
        "name = \"turned\"\n[[colliders]]\nshape = \"half-space\"\nrotation = {rotation}\n"
    );
    Scene::from_toml(&text, "turned.toml").map_err(|error| error.to_string())
}

/// Applies a rotation of a scene file to a vector.
fn turned(rotation: &str, vector: DVec3) -> DVec3 {
    let scene = scene(rotation).unwrap();
    DQuat::from_array(scene.colliders[0].rotation).normalize() * vector
}

fn close(a: DVec3, b: DVec3) {
    assert!((a - b).length() < ROUND_OFF, "{a} is not {b}");
}

#[test]
fn a_turn_about_an_axis_is_counterclockwise() {
    let quarter = "{ axis = [0, 0, 2], degrees = 90 }";
    close(turned(quarter, DVec3::X), DVec3::Y);
    close(turned(quarter, DVec3::Y), DVec3::NEG_X);
    close(turned("{ axis = [1, 1, 1], degrees = 120.0 }", DVec3::X), DVec3::Y);
    close(turned("{ axis = [0, 1, 0], degrees = -90 }", DVec3::X), DVec3::Z);
}

#[test]
fn euler_angles_turn_about_z_then_x_then_y() {
    close(turned("{ euler_degrees = [0, 0, 90] }", DVec3::X), DVec3::Y);
    // About z, x becomes y; about x, y becomes z; about y, z becomes x.
    close(turned("{ euler_degrees = [90, 90, 90] }", DVec3::X), DVec3::X);
    let angles = [10.0f64, 20.0, 30.0].map(f64::to_radians);
    let [x, y, z] = angles;
    let expected =
        DQuat::from_rotation_y(y) * DQuat::from_rotation_x(x) * DQuat::from_rotation_z(z);
    let vector = DVec3::new(1.0, 2.0, 3.0).normalize();
    close(turned("{ euler_degrees = [10, 20, 30] }", vector), expected * vector);
}

#[test]
fn a_normal_is_where_the_front_faces() {
    for (text, normal) in [
        ("[1, 0, 0]", DVec3::X),
        ("[0, 0, -3]", DVec3::NEG_Z),
        ("[0, 5, 0]", DVec3::Y),
        ("[0, -1, 0]", DVec3::NEG_Y),
        ("[1, -2, 3]", DVec3::new(1.0, -2.0, 3.0).normalize()),
        ("[1e-9, -1, 0]", DVec3::new(1e-9, -1.0, 0.0).normalize()),
    ] {
        close(turned(&format!("{{ normal = {text} }}"), DVec3::Y), normal);
    }
}

#[test]
fn quaternions_are_as_they_were() {
    let written = scene("[1, 2, 3, 4]").unwrap().colliders[0].rotation;
    assert_eq!(written, [1.0, 2.0, 3.0, 4.0]);
    // A scene is written with quaternions and is read back unchanged.
    let scene = scene("{ axis = [1, 2, 3], degrees = 40 }").unwrap();
    assert_eq!(Scene::from_toml(&scene.to_toml(), "again").unwrap(), scene);
}

#[test]
fn a_camera_looks_at_a_point() {
    let camera = |text: &str| {
        let text = format!("name = \"seen\"\n[camera]\n{text}\n");
        Scene::from_toml(&text, "seen.toml").map(|scene| scene.camera.unwrap())
    };
    for (position, target) in [
        (DVec3::new(3.0, 4.0, 5.0), DVec3::new(0.0, 1.0, 0.0)),
        (DVec3::new(-3.0, -4.0, -5.0), DVec3::ZERO),
        (DVec3::Y, DVec3::ZERO),
        (DVec3::Z, DVec3::X),
    ] {
        let (p, t) = (position.to_array(), target.to_array());
        let camera = camera(&format!("position = {p:?}\nlook_at = {t:?}")).unwrap();
        let rotation = DQuat::from_array(camera.rotation).normalize();
        close(rotation * DVec3::NEG_Z, (target - position).normalize());
        // The camera does not roll.
        assert!((rotation * DVec3::X).y.abs() < ROUND_OFF, "{rotation}");
        assert!((rotation * DVec3::Y).y > -ROUND_OFF, "{rotation}");
    }
    let both = camera("position = [1, 1, 1]\nrotation = [0, 0, 0, 1]\nlook_at = [0, 0, 0]");
    let error = both.unwrap_err().to_string();
    assert_eq!(error, "seen.toml:4: camera: takes `rotation` or `look_at`, not both");
    let nowhere = camera("position = [1, 1, 1]\nlook_at = [1, 1, 1]").unwrap_err().to_string();
    assert!(nowhere.contains("must be finite and not zero"), "{nowhere}");
}

#[test]
fn a_turn_that_makes_no_sense_is_refused_with_its_line() {
    for (rotation, problem) in [
        ("{ degrees = 30 }", "needs `axis` with `degrees`, or `euler_degrees`, or `normal`"),
        ("{}", "needs `axis` with `degrees`"),
        ("{ axis = [0, 1, 0], degrees = 1, normal = [0, 1, 0] }", "needs `axis` with"),
        ("{ axis = [0, 0, 0], degrees = 30 }", "axis must be finite and not zero"),
        ("{ normal = [0, inf, 0] }", "normal must be finite and not zero"),
        ("{ axis = [0, 1, 0], degrees = nan }", "an angle cannot be NaN"),
        ("{ axis = [0, 1, 0], radians = 1 }", "unknown field `radians`"),
        ("30", "a quaternion [x, y, z, w], { axis, degrees }"),
        (
            "[0, 0, 1]",
            "has three numbers, a quaternion four: angles about x, y and z in degrees are",
        ),
        ("[0, 1]", "has 2 values, not 4"),
    ] {
        let error = scene(rotation).unwrap_err();
        assert!(error.starts_with("turned.toml:4: colliders[0].rotation"), "{rotation}: {error}");
        assert!(error.contains(problem), "{rotation}: {error}");
    }
}
