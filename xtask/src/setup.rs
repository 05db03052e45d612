//! What the checks need besides the toolchain itself.

use crate::shell::{Outcome, run, succeeds};

/// Adds the toolchain's formatter and linter where they are missing.
pub fn toolchain() -> Outcome {
    for (command, component) in [("fmt", "rustfmt"), ("clippy", "clippy")] {
        if !succeeds("cargo", &[command, "--version"]) {
            run("rustup", &["component", "add", component])?;
        }
    }
    Ok(())
}
