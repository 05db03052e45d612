//! Programs of the registry, each installed into the target folder at a pinned version.

use std::path::PathBuf;

use crate::shell::{Outcome, cargo_with, output, target_folder};

/// A program of the registry.
pub struct Tool<'a> {
    pub package: &'a str,
    pub program: &'a str,
    pub version: &'a str,
    /// Further arguments of `cargo install`.
    pub arguments: &'a [&'a str],
}

impl Tool<'_> {
    /// Installs the program, unless the system or the target folder has this version. Returns where it lies.
    pub fn installed(&self) -> Outcome<PathBuf> {
        let own = target_folder().join("tools");
        let installed = own.join("bin").join(self.program);
        let has_version = |text: String| {
            text.split_whitespace().any(|word| word.trim_start_matches('v') == self.version)
        };
        for program in [PathBuf::from(self.program), installed.clone()] {
            if output(&program, &["--version"]).is_some_and(has_version) {
                return Ok(program);
            }
        }
        let root = own.to_string_lossy();
        // Unlocked, as it comes: what it was locked with is not in every registry. As it is quickest built:
        // it runs for seconds.
        let install = ["install", self.package, "--version", self.version, "--root", &root];
        let quick = [("CARGO_PROFILE_DEV_DEBUG", "false"), ("CARGO_INCREMENTAL", "0")];
        cargo_with(&[&install[..], &["--force", "--debug"], self.arguments].concat(), &quick)?;
        Ok(installed)
    }
}
