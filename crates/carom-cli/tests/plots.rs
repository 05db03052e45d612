//! The command `plot`: its numbers, its pictures, and what it refuses.
#![cfg(feature = "pictures")]

mod command;

use carom_render::Picture;
use command::{bad_line, good, path};
use tempfile::TempDir;

/// Acceleration in [`FALL`] \[m/s²\].
const G: f64 = 8.0;
/// Height of its ball at the start \[m\].
const HEIGHT: f64 = 5.0;
/// Mass of its ball \[kg\].
const MASS: f64 = 2.0;

/// A ball that falls freely.
const FALL: &str = r#"
name = "fall"
[simulation]
duration = 1.0
[[forces]]
gravity = { acceleration = [0.0, -8.0, 0.0] }
[[spheres]]
position = [0.0, 5.0, 0.0]
radius = 0.5
mass = 2.0
"#;

/// Writes [`FALL`] into a folder; returns the folder and the path of the scene.
fn fall() -> (TempDir, String) {
    let folder = tempfile::tempdir().unwrap();
    let scene = path(&folder, "fall.toml");
    std::fs::write(&scene, FALL).unwrap();
    (folder, scene)
}

/// Plots the fall into a file; returns its content.
fn plotted(arguments: &[&str], name: &str) -> Vec<u8> {
    let (folder, scene) = fall();
    let out = path(&folder, name);
    good(&[&["plot", &scene], arguments, &["--out", &out]].concat());
    std::fs::read(&out).unwrap()
}

/// Plots the fall as a table; returns its heading and its rows.
fn table(arguments: &[&str]) -> (String, Vec<Vec<f64>>) {
    let text = String::from_utf8(plotted(arguments, "plot.csv")).unwrap();
    let mut lines = text.lines().map(str::to_owned);
    let heading = lines.next().unwrap();
    let numbers = |line: String| line.split(',').map(|it| it.parse().unwrap()).collect();
    (heading, lines.map(numbers).collect())
}

#[test]
fn the_energies_of_a_falling_ball_are_those_of_its_height() {
    let (heading, rows) = table(&[]);
    assert_eq!(heading, "\"time, s\",\"kinetic, J\",\"potential, J\",\"total, J\"");
    assert_eq!(rows.len(), 61, "the start and 60 frames");
    for row in &rows {
        let [time, kinetic, potential, total] = row[..] else { panic!("{row:?}") };
        let speed = G * time;
        // Rounding of numbers of up to 80 J.
        assert!((kinetic - 0.5 * MASS * speed * speed).abs() < 1e-12, "{row:?}");
        assert!((total - MASS * G * HEIGHT).abs() < 1e-12, "{row:?}");
        assert!((kinetic + potential - total).abs() < 1e-12, "{row:?}");
    }
}

#[test]
fn height_and_speed_of_a_ball_are_plotted_without_saying_so() {
    let (heading, rows) = table(&["--ball", "0"]);
    assert_eq!(heading, "\"time, s\",\"Height of ball 0, m\",\"Speed of ball 0, m/s\"");
    for row in &rows {
        let [time, height, speed] = row[..] else { panic!("{row:?}") };
        assert!((height - (HEIGHT - 0.5 * G * time * time)).abs() < 1e-14, "{row:?}");
        assert!((speed - G * time).abs() < 1e-14, "{row:?}");
    }
}

#[test]
fn several_quantities_share_the_times_of_one_table() {
    let (heading, rows) = table(&["--ball", "0", "--of", "velocity,momentum"]);
    let names = ["\"time, s\"", "\"x, m/s\"", "\"y, m/s\"", "\"z, m/s\""];
    assert!(heading.starts_with(&names.join(",")), "{heading}");
    for row in &rows {
        let [_, _, velocity, _, _, momentum, _, size] = row[..] else { panic!("{row:?}") };
        assert!((MASS * velocity - momentum).abs() < 1e-14 && size == momentum.abs(), "{row:?}");
    }
}

#[test]
fn a_picture_has_two_pixels_for_a_point_and_a_figure_for_each_quantity() {
    let of = ["--of", "energy,momentum,impacts", "--size", "300x200"];
    let once = plotted(&of, "plot.png");
    let picture = Picture::from_png(&once).unwrap();
    let heading = 36;
    assert_eq!([picture.width, picture.height], [600, 2 * (3 * 200 + heading)]);
    assert_eq!(plotted(&of, "plot.png"), once);
    // Red is the kinetic energy, the x component of the momentum, and nothing else; the patch before a name
    // alone has some 400 pixels.
    let red = |rows: std::ops::Range<usize>| {
        let row = 4 * picture.width as usize;
        let pixels = picture.pixels[rows.start * row..rows.end * row].chunks_exact(4);
        pixels.filter(|it| it[..3] == [214, 80, 70]).count()
    };
    assert!(red(72..472) > 1000 && red(472..872) > 300, "{} {}", red(72..472), red(472..872));
    assert_eq!(red(872..1272), 0);
}

#[test]
fn a_drawing_names_its_curves_and_axes() {
    let text = String::from_utf8(plotted(&[], "plot.svg")).unwrap();
    for name in ["fall, rule exact", "Energy, J", "kinetic", "potential", "total", "time, s"] {
        assert!(text.contains(&format!("\n{name}\n")), "{name}: {text}");
    }
    assert!(text.starts_with("<svg ") && text.trim_end().ends_with("</svg>"));
}

#[test]
fn digits_and_decimal_commas_are_those_asked_for() {
    let arguments = ["--digits", "3", "--decimal-comma"];
    let text = String::from_utf8(plotted(&arguments, "plot.csv")).unwrap();
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("time, s;kinetic, J;potential, J;total, J"));
    assert_eq!(lines.next(), Some("0;0;80;80"));
    // After a frame of 1/60 s: m g² t² / 2 is 0.01777... J.
    assert_eq!(lines.next(), Some("0,0167;0,0178;80;80"));
    let drawing = String::from_utf8(plotted(&["--decimal-comma"], "plot.svg")).unwrap();
    assert!(drawing.contains("\n0,5\n") && !drawing.contains("\n0.5\n"), "{drawing}");
}

#[test]
fn without_a_file_the_plot_is_drawn_in_the_terminal() {
    let (_folder, scene) = fall();
    let text = good(&["plot", &scene, "--ball", "0", "--of", "height"]);
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines[0], "fall, rule exact");
    assert_eq!(lines[2], "Height of ball 0, m");
    // From 5 m at the upper left to 1 m at the lower right, and nowhere a code for a colour.
    let rows: Vec<&str> = lines.iter().filter_map(|it| Some(it.split_once('│')?.1)).collect();
    let is_drawn = |row: &str| row.chars().any(|it| ('\u{2801}'..='\u{28ff}').contains(&it));
    assert_eq!(rows.len(), 14);
    assert!(rows[0].starts_with(|it: char| it > '\u{2800}') && is_drawn(rows[13]), "{text}");
    assert!(rows.iter().all(|row| is_drawn(row)) && !text.contains('\u{1b}'), "{text}");
    assert!(lines.iter().any(|it| it.trim_start().starts_with("4 │")), "{text}");
    assert_eq!(lines.last().map(|it| it.trim()), Some("time, s"));
}

#[test]
fn an_empty_world_has_a_plot() {
    let folder = tempfile::tempdir().unwrap();
    let (scene, out) = (path(&folder, "nothing.toml"), path(&folder, "nothing.svg"));
    std::fs::write(&scene, "name = \"nothing\"").unwrap();
    let all = "energy,momentum,impacts,speeds,gas,work";
    good(&["plot", &scene, "--seconds", "0.1", "--of", all, "--out", &out]);
    assert!(std::fs::read_to_string(&out).unwrap().contains("Balls by speed"));
}

#[test]
fn what_cannot_be_plotted_is_said_in_a_line() {
    let (folder, scene) = fall();
    let out = path(&folder, "plot.svg");
    let refused =
        |arguments: &[&str], code| bad_line(&[&["plot", &scene], arguments].concat(), code);
    let other = path(&folder, "plot.pdf");
    assert!(refused(&["--out", &other], 2).contains("must end in .png, .svg or .csv"));
    assert!(refused(&["--out", "-"], 2).contains("a plot goes into a file"));
    let of_ball = refused(&["--of", "height", "--out", &out], 2);
    assert!(of_ball.contains("--ball must name the ball"), "{of_ball}");
    let no_ball = refused(&["--ball", "1", "--out", &out], 2);
    assert!(no_ball.contains("there is no ball 1"), "{no_ball}");
    let needless = refused(&["--ball", "0", "--of", "energy", "--out", &out], 2);
    assert!(needless.contains("--ball needs a quantity of a ball"), "{needless}");
    assert!(refused(&["--digits", "3", "--out", &out], 2).contains("--digits is for tables"));
    std::fs::write(&out, "mine").unwrap();
    assert!(refused(&["--out", &out], 2).contains("--force"));
    assert_eq!(std::fs::read_to_string(&out).unwrap(), "mine");
}
