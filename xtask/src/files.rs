//! Copies, makes and finds files and folders.

use std::fs;
use std::path::{Component, Path, PathBuf};

use crate::shell::Outcome;

/// Copies a file, or a folder with its contents.
pub fn copy(from: &Path, to: &Path) -> Outcome {
    if !from.is_dir() {
        return fs::copy(from, to).map(drop).map_err(|error| said(from, &error));
    }
    fs::create_dir_all(to).map_err(|error| said(to, &error))?;
    for entry in fs::read_dir(from).map_err(|error| said(from, &error))? {
        let entry = entry.map_err(|error| said(from, &error))?;
        copy(&entry.path(), &to.join(entry.file_name()))?;
    }
    Ok(())
}

/// Removes a folder with its contents, if it exists.
pub fn remove(folder: &Path) -> Outcome {
    if folder.exists() {
        fs::remove_dir_all(folder).map_err(|error| said(folder, &error))?;
    }
    Ok(())
}

/// Makes a folder if it does not exist. Returns it.
pub fn made(folder: PathBuf) -> Outcome<PathBuf> {
    fs::create_dir_all(&folder).map_err(|error| said(&folder, &error))?;
    Ok(folder)
}

/// Makes a folder, or empties it. Returns it.
pub fn emptied(folder: PathBuf) -> Outcome<PathBuf> {
    remove(&folder)?;
    made(folder)
}

/// Returns the only file in a folder.
pub fn only_file(folder: &Path) -> Outcome<PathBuf> {
    let entries = fs::read_dir(folder).map_err(|error| said(folder, &error))?;
    let mut files: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    match (files.pop(), files.len()) {
        (Some(file), 0) => Ok(file),
        _ => Err(format!("{} should hold one file", folder.display())),
    }
}

/// Returns a path without `.` and `..`.
pub fn normal(path: &Path) -> PathBuf {
    let mut whole = PathBuf::new();
    for component in path.components() {
        match component {
            Component::ParentDir => drop(whole.pop()),
            Component::CurDir => {}
            other => whole.push(other),
        }
    }
    whole
}

/// Returns the message for an error of a file or folder.
pub fn said(path: &Path, error: &std::io::Error) -> String {
    format!("{}: {error}", path.display())
}
