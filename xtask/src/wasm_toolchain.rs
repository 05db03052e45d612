//! Finds a compiler with a standard library for browsers.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::setup;
use crate::shell::{Outcome, cargo_program, finish, output, succeeds};

/// The compilation target of browsers.
pub const TARGET: &str = "wasm32-unknown-unknown";

/// A compiler for browsers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WasmToolchain {
    /// The compiler that runs this program, with the target's standard library installed.
    Installed,
    /// Debian's compiler, which compiles its standard library from source.
    Debian,
}

/// Debian's own programs, whatever comes first on the path.
const DEBIAN_CARGO: &str = "/usr/bin/cargo";
const DEBIAN_RUSTC: &str = "/usr/bin/rustc";

impl WasmToolchain {
    /// Returns the installed compiler, and adds its target if needed; if the target cannot be
    /// downloaded, returns Debian's.
    pub fn find() -> Outcome<Self> {
        if has_standard_library("rustc") || succeeds("rustup", &["target", "add", TARGET]) {
            return Ok(Self::Installed);
        }
        eprintln!("xtask: the standard library for {TARGET} cannot be fetched; Debian's is built");
        setup::debian_wasm()?;
        if standard_library_source().is_none() {
            return Err(format!(
                "there is no standard library for {TARGET}: install it with `rustup target add \
                 {TARGET}`, or Debian's packages rustc-web, cargo-web, rust-web-src and lld-22"
            ));
        }
        Ok(Self::Debian)
    }

    /// Runs cargo with these arguments for the target.
    pub fn cargo(self, arguments: &[&str]) -> Outcome {
        match self {
            Self::Installed => {
                let mut command = Command::new(cargo_program());
                finish("cargo", command.args(arguments).args(["--target", TARGET]))
            }
            Self::Debian => {
                let mut command = Command::new(DEBIAN_CARGO);
                command
                    .args(arguments)
                    .args(["--target", TARGET, "-Z", "build-std=std,panic_abort"])
                    .env("PATH", with_first("/usr/bin"))
                    .env("RUSTC", DEBIAN_RUSTC)
                    // A stable compiler needs this to build its own standard library.
                    .env("RUSTC_BOOTSTRAP", "1")
                    .env("CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER", "wasm-ld-22");
                finish(DEBIAN_CARGO, &mut command)
            }
        }
    }
}

/// Returns whether a compiler has the standard library of the target.
fn has_standard_library(rustc: &str) -> bool {
    output(rustc, &["--print", "target-libdir", "--target", TARGET])
        .is_some_and(|folder| Path::new(folder.trim()).is_dir())
}

/// Returns the folder of the standard library's source of Debian's compiler.
fn standard_library_source() -> Option<PathBuf> {
    let sysroot = output(DEBIAN_RUSTC, &["--print", "sysroot"])?;
    let source = Path::new(sysroot.trim()).join("lib/rustlib/src/rust/library/std");
    source.is_dir().then_some(source)
}

/// Returns the search path of programs with a folder put first.
fn with_first(folder: &str) -> std::ffi::OsString {
    let path = std::env::var_os("PATH").unwrap_or_default();
    let folders = std::iter::once(PathBuf::from(folder)).chain(std::env::split_paths(&path));
    std::env::join_paths(folders).unwrap_or(path.clone())
}
