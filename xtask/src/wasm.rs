//! What a browser runs: checked, and built.

use std::path::PathBuf;

use crate::shell::{Outcome, target_folder};
use crate::wasm_toolchain::{TARGET, WasmToolchain};

/// Checks all that a browser is to run for its target.
pub fn check() -> Outcome {
    let toolchain = WasmToolchain::find()?;
    let packages = [
        "carom",
        "carom-scene",
        "carom-js",
        "carom-render",
        "carom-maze",
        "carom-session",
        "carom-view",
        "carom-web",
    ];
    for package in packages {
        toolchain.cargo(&["check", "--quiet", "--package", package, "--no-default-features"])?;
    }
    Ok(())
}

/// Builds a package for browsers, as small as may be. Returns the module.
pub fn build(package: &str) -> Outcome<PathBuf> {
    const PROFILE: &str = "web";
    let toolchain = WasmToolchain::find()?;
    toolchain.cargo(&["build", "--package", package, "--profile", PROFILE])?;
    let file = format!("{}.wasm", package.replace('-', "_"));
    Ok(target_folder().join(TARGET).join(PROFILE).join(file))
}
