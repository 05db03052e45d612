//! The main job, shown: every built-in scene, run.

use carom_scene::Library;

use crate::setup;
use crate::shell::{Outcome, cargo};

/// Runs every built-in scene and prints its table.
pub fn demo() -> Outcome {
    setup::toolchain()?;
    cargo(&["build", "--release", "--package", "carom-cli"])?;
    for entry in Library::new().entries().map_err(|error| error.to_string())? {
        let run = ["run", "--release", "--quiet", "--package", "carom-cli", "--", "run"];
        cargo(&[&run[..], &[entry.name.as_str()]].concat())?;
    }
    Ok(())
}
