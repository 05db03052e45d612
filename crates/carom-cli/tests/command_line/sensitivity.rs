//! Derivatives of a run as columns of its table.

use crate::command::{bad_line, good, path};
use crate::rows;

/// Acceleration in [`BOUNCE`] \[m/s²\].
const G: f64 = 10.0;
/// Height of its ball above the floor at the start \[m\].
const HEIGHT: f64 = 1.25;
/// Restitution of the scene.
const RESTITUTION: f64 = 0.8;

/// A ball that falls onto a floor, and one far away.
const BOUNCE: &str = r#"
[simulation]
frame_time = 0.125
[[forces]]
gravity = { acceleration = [0.0, -10.0, 0.0] }
[[spheres]]
position = [0.0, 1.35, 0.0]
radius = 0.1
[[spheres]]
position = [9.0, 90.0, 0.0]
radius = 0.1
[[colliders]]
shape = "half-space"
restitution = 0.8
"#;

/// A ball that meets two walls of its box at 0.9 s.
const CORNER: &str = r#"
[simulation]
frame_time = 0.125
[[spheres]]
velocity = [1.0, 1.0, 0.0]
radius = 0.1
[[colliders]]
shape = { container = { size = [2.0, 2.0, 2.0] } }
"#;

/// Runs the bounce for a second with derivatives by these numbers. Returns the names of the added columns, and
/// their numbers in the last row of each ball.
fn run(numbers: &[&str]) -> (Vec<String>, [Vec<f64>; 2]) {
    let folder = tempfile::tempdir().unwrap();
    let (scene, table) = (path(&folder, "bounce.toml"), path(&folder, "t.csv"));
    std::fs::write(&scene, BOUNCE).unwrap();
    let mut arguments = vec!["run", &scene, "--seconds", "1", "--out", &table];
    arguments.extend(numbers.iter().flat_map(|number| ["--sensitivity", number]));
    good(&arguments);
    let (header, rows) = rows(&table);
    let names = header.iter().skip(8).map(str::to_owned).collect();
    let last = |ball: &str| {
        let row = rows.iter().rfind(|row| row[1] == ball).unwrap();
        row[8..].iter().map(|field| field.parse().unwrap()).collect()
    };
    (names, [last("0"), last("1")])
}

/// Asserts numbers equal to rounding.
fn assert_near(numbers: &[f64], expected: &[f64]) {
    assert_eq!(numbers.len(), expected.len());
    for (number, expected) in numbers.iter().zip(expected) {
        assert!((number - expected).abs() < 1e-13, "{number}, expected {expected}");
    }
}

#[test]
fn columns_of_derivatives_have_the_closed_form_of_a_bounce() {
    let (names, [bouncing, falling]) =
        run(&["spheres.0.position.1", "colliders.0.restitution", "acceleration.1"]);
    assert_eq!(names[..2], ["dx/d(spheres.0.position.1)", "dy/d(spheres.0.position.1)"]);
    assert_eq!(names[16], "dvy/d(acceleration.1)");
    // y = e v τ - g τ²/2 with the speed v = g t of the impact at t = √(2 h/g), and τ = 1 - t.
    let t = (2.0 * HEIGHT / G).sqrt();
    let (e, v, after) = (RESTITUTION, G * t, 1.0 - t);
    let by_height = [0.0, (1.0 + e) * G * after / v - e, 0.0, 0.0, (1.0 + e) * G / v, 0.0];
    assert_near(&bouncing[..6], &by_height);
    assert_near(&bouncing[6..12], &[0.0, v * after, 0.0, 0.0, v, 0.0]);
    // Upwards: g falls by one. dt/dg = -t/(2 g), dv/dg = t/2.
    let by_gravity =
        e * (t / 2.0 * after + v * t / (2.0 * G)) - after * after / 2.0 - after * t / 2.0;
    let speed_by_gravity = e * t / 2.0 - after - t / 2.0;
    assert_near(&bouncing[12..], &[0.0, -by_gravity, 0.0, 0.0, -speed_by_gravity, 0.0]);
    // What the other ball starts with changes nothing.
    assert_near(&falling[..12], &[0.0; 12]);
    assert_near(&falling[12..], &[0.0, 0.5, 0.0, 0.0, 1.0, 0.0]);
}

#[test]
fn a_vector_means_its_three_components() {
    let (names, [_, falling]) = run(&["spheres.1.velocity"]);
    assert_eq!(names.len(), 18);
    assert_eq!(names[12], "dx/d(spheres.1.velocity.2)");
    let expected = [
        [1.0, 0.0, 0.0, 1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0, 0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0, 0.0, 0.0, 1.0],
    ];
    assert_near(&falling, expected.as_flattened());
}

#[test]
fn a_number_that_derivatives_are_not_known_by_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let (scene, table) = (path(&folder, "bounce.toml"), path(&folder, "t.csv"));
    std::fs::write(&scene, BOUNCE).unwrap();
    let line = |number: &str, out: &str| {
        bad_line(&["run", &scene, "--out", out, "--sensitivity", number, "--frames", "1"], 2)
    };
    for (number, why) in [
        ("spheres.2.velocity", "there are fewer spheres"),
        ("spheres.velocity", "a number comes after spheres"),
        ("spheres.0.velocity.3", "a component is 0, 1 or 2"),
        ("spheres.0.radius.0", "it has no components"),
        ("colliders.0.mass", "there are no derivatives by this field"),
        ("forces.0", "it names neither a sphere, nor a collider"),
        ("spheres.0.position.0.0", "it has too many parts"),
    ] {
        let line = line(number, &table);
        assert!(line.contains(&format!("--sensitivity {number}: {why}")), "{line}");
    }
    let line = line("spheres.0.velocity", &path(&folder, "t.npz"));
    assert!(line.contains("t.npz has no columns for further numbers: use .csv"), "{line}");
}

#[test]
fn where_there_is_no_derivative_the_run_ends_and_keeps_the_frames_before() {
    let folder = tempfile::tempdir().unwrap();
    let (scene, table) = (path(&folder, "corner.toml"), path(&folder, "t.csv"));
    std::fs::write(&scene, CORNER).unwrap();
    let arguments = ["run", &scene, "--out", &table, "--sensitivity", "spheres.0.velocity"];
    let line = bad_line(&[&arguments[..], &["--rule", "contact"]].concat(), 1);
    assert!(line.contains("derivatives are not known of"), "{line}");
    let line = bad_line(&arguments, 1);
    assert!(line.contains("sphere 0 has several impacts at 0.9 s at once"), "{line}");
    // The names, and a row for each of the frames until 0.875 s.
    assert_eq!(std::fs::read_to_string(&table).unwrap().lines().count(), 1 + 7);
}
