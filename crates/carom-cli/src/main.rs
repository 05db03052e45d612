//! `carom`: runs scenes of moving spheres from the command line.

#![warn(clippy::unwrap_used)]

mod args;
mod bench;
mod compare;
mod failure;
mod gas;
mod interruption;
mod link;
mod machine;
mod numbers;
#[cfg(feature = "pictures")]
mod pictures;
mod progress;
mod run;
mod scenes;
mod summary;
mod table;
mod verify;
#[cfg(feature = "view")]
mod window;

use std::process::ExitCode;

use clap::Parser;

use args::{Args, Command};

fn main() -> ExitCode {
    let (folders, command) = Args::parse().split();
    let library = || folders.library();
    let result = match &command {
        Command::Scenes { json } => library().and_then(|it| scenes::list(&it, *json)),
        Command::Check { files } => scenes::check(files),
        Command::Show(show) => library().and_then(|it| scenes::show(&it, show)),
        Command::Run(run) => library().and_then(|it| run::run(&it, run)),
        Command::Link(link) => library().and_then(|it| link::link(&it, link)),
        Command::Verify(verify) => verify::verify(verify),
        Command::Compare(compare) => library().and_then(|it| compare::compare(&it, compare)),
        Command::Bench(bench) => bench::bench(bench),
        #[cfg(feature = "pictures")]
        Command::Picture(picture) => library().and_then(|it| pictures::picture(&it, picture)),
        #[cfg(feature = "pictures")]
        Command::Record(record) => library().and_then(|it| pictures::record(&it, record)),
        #[cfg(feature = "pictures")]
        Command::Maze(maze) => library().and_then(|it| pictures::maze(it, maze)),
        #[cfg(feature = "view")]
        Command::View(view) => library().and_then(|it| window::view(it, view)),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}
