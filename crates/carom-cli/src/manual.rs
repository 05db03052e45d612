//! Shell completions and manual pages.

use std::io::{self, Write};
use std::path::Path;

use clap::CommandFactory;

use crate::args::{Args, Completions};
use crate::failure::{Failure, unwritable};

/// Prints the completion script of a shell.
pub fn completions(completions: &Completions) -> Result<(), Failure> {
    let mut script = Vec::new();
    clap_complete::generate(completions.shell, &mut Args::command(), "carom", &mut script);
    Ok(io::stdout().lock().write_all(&script)?)
}

/// Writes manual pages into a folder.
pub fn pages(folder: &Path) -> Result<(), Failure> {
    let failed = |error| unwritable(folder, &error);
    std::fs::create_dir_all(folder).map_err(failed)?;
    clap_mangen::generate_to(Args::command(), folder).map_err(failed)
}
