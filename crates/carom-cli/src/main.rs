//! `carom`: runs scenes of moving spheres from the command line.

#![warn(clippy::unwrap_used)]

mod args;
mod bench;
mod compare;
mod failure;
mod gas;
mod machine;
mod numbers;
mod run;
mod scenes;
mod summary;
mod table;
mod verify;

use std::process::ExitCode;

use clap::Parser;

use args::{Args, Command};

fn main() -> ExitCode {
    let args = Args::parse();
    let result = match &args.command {
        Command::Scenes { json } => args.library().and_then(|it| scenes::list(&it, *json)),
        Command::Check { files } => scenes::check(files),
        Command::Show(show) => args.library().and_then(|it| scenes::show(&it, show)),
        Command::Run(run) => args.library().and_then(|it| run::run(&it, run)),
        Command::Verify(verify) => verify::verify(verify),
        Command::Compare(compare) => args.library().and_then(|it| compare::compare(&it, compare)),
        Command::Bench(bench) => bench::bench(bench),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}
