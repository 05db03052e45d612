//! What a browser runs: built.

use std::path::PathBuf;

use crate::shell::{Outcome, target_folder};
use crate::wasm_toolchain::{TARGET, WasmToolchain};

/// Builds a package for browsers, as small as may be. Returns the module.
pub fn build(package: &str) -> Outcome<PathBuf> {
    const PROFILE: &str = "web";
    let toolchain = WasmToolchain::find()?;
    toolchain.cargo(&["build", "--package", package, "--profile", PROFILE])?;
    let file = format!("{}.wasm", package.replace('-', "_"));
    Ok(target_folder().join(TARGET).join(PROFILE).join(file))
}
