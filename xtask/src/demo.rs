//! Demonstrates Carom: runs, draws and films scenes, and opens the window if there is a display.

use serde_json::Value;

use crate::setup;
use crate::shell::{CI, Outcome, cargo, finish, output, program};

/// Runs every built-in scene and prints its table, makes pictures and a film in `out/`, and opens
/// the window.
pub fn demo() -> Outcome {
    // Scenes need no graphics, so their tables come before anything else is built or installed.
    build(&["--no-default-features", "--features", "rayon"])?;
    for scene in scenes()? {
        carom(&["run", &scene])?;
    }
    setup::graphics()?;
    build(&[])?;
    carom(&["picture", "simtest1", "--at", "5", "--out", "out/simtest1.png", "-f"])?;
    carom(&["picture", "tutorial3", "--at", "2.5", "--out", "out/tutorial3.png", "-f"])?;
    carom(&["record", "simtest1", "--seconds", "6", "--out", "out/simtest1.mp4", "-f"])?;
    let displays = ["DISPLAY", "WAYLAND_DISPLAY"];
    let has_display = !cfg!(target_os = "linux")
        || displays.iter().any(|name| std::env::var_os(name).is_some_and(|it| !it.is_empty()));
    if has_display {
        carom(&["view"])?;
    } else {
        eprintln!("\nThere is no display; with one, this ends with the window (`carom view`).");
    }
    eprintln!("Open out/simtest1.mp4, out/simtest1.png and out/tutorial3.png.");
    Ok(())
}

/// Builds the command with these features.
fn build(features: &[&str]) -> Outcome {
    cargo(&[&["build", "--profile", CI, "--package", "carom-cli"], features].concat())
}

/// Runs the command.
fn carom(arguments: &[&str]) -> Outcome {
    finish("carom", program("carom").args(arguments))
}

/// Returns the names of the built-in scenes in the order of the chooser.
fn scenes() -> Outcome<Vec<String>> {
    let listed = output(program("carom").get_program(), &["scenes", "--json"]);
    let listed = listed.and_then(|text| serde_json::from_str::<Vec<Value>>(&text).ok());
    let listed = listed.ok_or("carom scenes --json lists no scenes")?;
    Ok(listed.iter().filter_map(|scene| scene["name"].as_str()).map(str::to_owned).collect())
}
