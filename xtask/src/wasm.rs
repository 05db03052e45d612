//! Builds the WebAssembly modules for browsers.

use std::path::PathBuf;

use crate::shell::{Outcome, target_folder};
use crate::wasm_toolchain::{TARGET, WasmToolchain};

/// The purpose of a module.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Purpose {
    /// For users: small if it is loaded as a whole, otherwise fast.
    Use,
    /// For tests: built in a fifth of the time.
    Test,
}

/// All packages that are built for browsers.
const PACKAGES: [&str; 2] = ["carom-web", "carom-js"];

/// Builds a package for browsers. Returns the module.
pub fn build(package: &str, purpose: Purpose) -> Outcome<PathBuf> {
    let toolchain = WasmToolchain::find()?;
    let profile = match (purpose, package) {
        (Purpose::Test, _) => "ci-web",
        // Unlike the page, the package is small with any optimisation.
        (Purpose::Use, "carom-js") => "dist",
        (Purpose::Use, _) => "web",
    };
    // For tests all at once, so that shared dependencies are built once.
    let packages = match purpose {
        Purpose::Test => &PACKAGES[..],
        Purpose::Use => &[package],
    };
    let packages: Vec<&str> = packages.iter().flat_map(|it| ["--package", it]).collect();
    toolchain.cargo(&[&["build", "--quiet", "--profile", profile], &packages[..]].concat())?;
    let file = format!("{}.wasm", package.replace('-', "_"));
    Ok(target_folder().join(TARGET).join(profile).join(file))
}
