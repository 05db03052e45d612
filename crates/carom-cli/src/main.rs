//! `carom`: runs scenes of moving spheres from the command line.

#![warn(clippy::unwrap_used)]

mod args;
mod failure;
mod run;
mod scenes;
mod summary;

use std::process::ExitCode;

use clap::Parser;

use args::{Args, Command};

fn main() -> ExitCode {
    let args = Args::parse();
    let result = args.library().and_then(|library| match &args.command {
        Command::Scenes { json } => scenes::list(&library, *json),
        Command::Check { files } => scenes::check(files),
        Command::Show(show) => scenes::show(&library, show),
        Command::Run(run) => run::run(&library, run),
    });
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}
