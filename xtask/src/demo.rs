//! The main job, shown: scenes run, drawn and filmed, and the window where there is a display.

use carom_scene::Library;

use crate::setup;
use crate::shell::{Outcome, cargo};

/// Runs every built-in scene and prints its table, makes a picture and a film in `out/`, and opens
/// the window.
pub fn demo() -> Outcome {
    setup::toolchain()?;
    setup::graphics()?;
    cargo(&["build", "--release", "--package", "carom-cli"])?;
    for entry in Library::new().entries().map_err(|error| error.to_string())? {
        carom(&["run", &entry.name])?;
    }
    carom(&["picture", "simtest1", "--at", "5", "--out", "out/simtest1.png"])?;
    carom(&["picture", "tutorial3", "--at", "2.5", "--out", "out/tutorial3.png"])?;
    carom(&["record", "simtest1", "--seconds", "6", "--out", "out/simtest1.mp4"])?;
    eprintln!("\nout/ holds simtest1.png, tutorial3.png and simtest1.mp4.");
    let displays = ["DISPLAY", "WAYLAND_DISPLAY"];
    let has_display = !cfg!(target_os = "linux")
        || displays.iter().any(|name| std::env::var_os(name).is_some_and(|it| !it.is_empty()));
    if has_display {
        carom(&["view"])
    } else {
        eprintln!("There is no display; with one, this ends with the window (`carom view`).");
        Ok(())
    }
}

/// Runs the command that was built.
fn carom(arguments: &[&str]) -> Outcome {
    let run = ["run", "--release", "--quiet", "--package", "carom-cli", "--"];
    cargo(&[&run[..], arguments].concat())
}
