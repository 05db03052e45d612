//! The folder of files that a release publishes.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::files::{self, emptied, made, remove, said};
use crate::shell::{Outcome, finish, printed, succeeds, target_folder};

/// Name of the file of checksums.
pub const CHECKSUMS: &str = "SHA256SUMS";

/// Programs, with arguments, that print checksums in the format of `sha256sum -c`: GNU's, then that
/// of macOS.
const PROGRAMS: [&[&str]; 2] = [&["sha256sum"], &["shasum", "--algorithm", "256"]];

/// Returns the folder of the archives.
pub fn folder() -> Outcome<PathBuf> {
    made(target_folder().join("release-files"))
}

/// Returns an empty folder to assemble an archive in.
pub fn staging(name: &str) -> Outcome<PathBuf> {
    emptied(target_folder().join("release-staging").join(name))
}

/// Removes earlier archives.
pub fn clear() -> Outcome {
    remove(&target_folder().join("release-files"))
}

/// Copies a file, or a folder with its contents, and makes missing folders.
pub fn copy(from: &Path, to: &Path) -> Outcome {
    made(to.parent().unwrap_or(to).to_owned())?;
    files::copy(from, to)
}

/// Copies a file into the folder of the release. Returns its path.
pub fn publish(file: &Path) -> Outcome<PathBuf> {
    let place = folder()?.join(file.file_name().unwrap_or_default());
    copy(file, &place)?;
    Ok(place)
}

/// Returns the names of the archives in order.
pub fn names() -> Outcome<Vec<String>> {
    let folder = folder()?;
    let entries = fs::read_dir(&folder).map_err(|error| said(&folder, &error))?;
    let names = entries.map(|entry| Ok(entry?.file_name().to_string_lossy().into_owned()));
    let names: Result<Vec<String>, std::io::Error> = names.collect();
    let mut names = names.map_err(|error| said(&folder, &error))?;
    names.retain(|name| name != CHECKSUMS);
    names.sort_unstable();
    Ok(names)
}

/// Writes the checksums of all archives.
pub fn write_checksums() -> Outcome {
    let program = PROGRAMS.iter().find(|program| succeeds(program[0], &["--version"]));
    let program = program.ok_or("there is neither sha256sum nor shasum")?;
    let mut command = Command::new(program[0]);
    command.args(&program[1..]).args(names()?).current_dir(folder()?);
    let checksums = printed(program[0], &mut command)?;
    write(&folder()?.join(CHECKSUMS), checksums)
}

/// Runs a program in a folder.
pub fn run_in(folder: &Path, name: &str, command: &mut Command) -> Outcome {
    finish(name, command.current_dir(folder))
}

/// Writes a file.
pub fn write(file: &Path, content: impl AsRef<[u8]>) -> Outcome {
    made(file.parent().unwrap_or(file).to_owned())?;
    fs::write(file, content).map_err(|error| said(file, &error))
}
