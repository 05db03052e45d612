//! `carom`: runs scenes of moving spheres from the command line.

#![warn(clippy::unwrap_used)]

use std::process::ExitCode;

/// Requests large pages, which many Linux systems give only on request: a world of many spheres
/// then waits less for addresses to be translated.
#[cfg(target_os = "linux")]
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> ExitCode {
    ExitCode::from(carom_cli::main(std::env::args_os(), Vec::new()))
}
