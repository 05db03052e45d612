//! The main job, shown: scenes run, drawn and filmed, and the window where there is a display.

use std::path::PathBuf;
use std::process::Command;

use carom_scene::Library;

use crate::setup;
use crate::shell::{Outcome, cargo, finish, target_folder};

/// The profile of the command that runs scenes first: the one that this program is built with, so
/// that half of it is there already. It runs every scene in a second.
const QUICK: &str = "quick";

/// Runs every built-in scene and prints its table, makes a picture and a film in `out/`, and opens
/// the window.
pub fn demo() -> Outcome {
    // Scenes need no graphics: their tables come first, while nothing else is built or installed.
    let plain = ["--package", "carom-cli", "--no-default-features"];
    cargo(&[&["build", "--profile", QUICK], &plain[..]].concat())?;
    for entry in Library::new().entries().map_err(|error| error.to_string())? {
        carom(QUICK, &["run", &entry.name])?;
    }
    setup::graphics()?;
    cargo(&["build", "--release", "--package", "carom-cli"])?;
    let carom = |arguments: &[&str]| carom("release", arguments);
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

/// Runs the command that was built with a profile.
fn carom(profile: &str, arguments: &[&str]) -> Outcome {
    let name = format!("carom{}", std::env::consts::EXE_SUFFIX);
    let program: PathBuf = [target_folder(), profile.into(), name.into()].iter().collect();
    finish("carom", Command::new(program).args(arguments))
}
