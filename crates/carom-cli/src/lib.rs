//! The command line of Carom: the programs `carom` and `python -m carom`. The drawing code is also
//! available as a library (`pictures`).

#![warn(clippy::unwrap_used)]

mod advice;
mod args;
mod bench;
mod breach;
mod choice;
mod compare;
mod config;
mod contact_totals;
mod energy_balance;
mod escapes;
mod failure;
mod gas;
mod grade;
mod import;
mod interruption;
mod length;
mod link;
mod machine;
mod manual;
mod new;
mod numbers;
mod pack;
#[cfg(feature = "pictures")]
pub mod pictures;
#[cfg(feature = "pictures")]
mod plot;
mod progress;
mod recover;
mod replacing;
mod run;
mod scenes;
mod sensitivity;
mod stage_work;
mod standard_input;
mod stress;
mod summary;
mod table;
mod verify;
mod well_totals;
#[cfg(feature = "view")]
mod window;
mod written;
mod zone_totals;

use std::ffi::OsString;

use carom_scene::{Budget, Library, Scene};
use clap::Parser;

use args::{Args, Command};
use config::Config;
use failure::Failure;

/// Runs the command in `arguments`, which start with the name of the program; returns the exit
/// code. Scenes in `registered` are found by name besides those on the disk.
pub fn main(arguments: impl IntoIterator<Item = OsString>, registered: Vec<Scene>) -> u8 {
    let arguments: Vec<OsString> = arguments.into_iter().collect();
    let result = match Args::try_parse_from(&arguments) {
        Ok(args) => obey(args, registered),
        Err(refusal) => {
            let text = refusal.render().to_string();
            let steers = |it: &OsString| it.to_string_lossy().contains(carom_scene::steers);
            if refusal.use_stderr() && arguments.iter().any(steers) {
                // The message may quote an argument with control characters, which may come from a
                // link.
                text.lines().for_each(failure::complain);
            } else {
                // If the output is closed, the text is lost.
                refusal.print().ok();
            }
            return refusal.exit_code().try_into().unwrap_or(failure::USAGE);
        }
    };
    match result {
        Ok(()) => 0,
        Err(failure) => failure.report(),
    }
}

fn obey(args: Args, registered: Vec<Scene>) -> Result<(), Failure> {
    let (sources, command) = args.split();
    let config = Config::load()?;
    let library = || -> Result<Library, Failure> {
        let mut library = sources.library(&config)?;
        registered.into_iter().try_for_each(|scene| library.register(scene))?;
        Ok(library)
    };
    match &command {
        Command::Scenes { json } => scenes::list(&library()?, *json),
        Command::New(new) => new::new(new),
        Command::Import(it) => import::import(it),
        Command::Pack(it) => pack::pack(it),
        Command::Check { files } => {
            scenes::check(&library()?, files, sources.budget(Budget::FILE, &config)?)
        }
        Command::Show(show) => scenes::show(&library()?, show),
        Command::Run(run) => run::run(&library()?, run, sources.budget(Budget::LINK, &config)?),
        Command::Recover(it) => recover::recover(it),
        Command::Link(link) => link::link(&library()?, link, &config),
        Command::Grade(grade) => grade::grade(&library()?, grade),
        Command::Verify(verify) => verify::verify(verify),
        Command::Compare(compare) => compare::compare(&library()?, compare),
        Command::Bench(bench) => bench::bench(bench),
        Command::Completions(completions) => manual::completions(completions),
        Command::Man { folder } => manual::pages(folder),
        #[cfg(feature = "pictures")]
        Command::Picture(picture) => pictures::picture(&library()?, picture),
        #[cfg(feature = "pictures")]
        Command::Plot(it) => plot::plot(&library()?, it),
        #[cfg(feature = "pictures")]
        Command::Record(record) => pictures::record(&library()?, record),
        #[cfg(feature = "pictures")]
        Command::Maze(maze) => pictures::maze(library()?, maze, &config),
        #[cfg(feature = "view")]
        Command::View(view) => {
            window::view(library()?, view, &config, sources.budget(Budget::LINK, &config)?)
        }
    }
}
