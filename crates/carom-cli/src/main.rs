//! `carom`: runs scenes of moving spheres from the command line.

#![warn(clippy::unwrap_used)]

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(carom_cli::main(std::env::args_os(), Vec::new()))
}
