//! That everything which a browser is to run builds for it.

use crate::setup;
use crate::shell::{Outcome, cargo};

const TARGET: &str = "wasm32-unknown-unknown";

/// Checks the physics, the scenes, the renderer and the interface for the browser's target.
pub fn check() -> Outcome {
    setup::browser_target(TARGET)?;
    let packages =
        ["carom", "carom-scene", "carom-render", "carom-maze", "carom-session", "carom-view"];
    for package in packages {
        cargo(&[
            "check",
            "--quiet",
            "--package",
            package,
            "--target",
            TARGET,
            "--no-default-features",
        ])?;
    }
    Ok(())
}
