//! Detects changes of a scene file that is edited while it is in use.

use std::path::{Path, PathBuf};
use std::time::SystemTime;

use crate::text::named_files;

/// A scene file with the files that it includes, and the state in which each was seen last.
#[derive(Debug, Clone)]
pub struct ChangedFile {
    path: PathBuf,
    files: Vec<(PathBuf, Option<Seen>)>,
}

/// When a file was last modified, and its length \[bytes\]: a file that is emptied and written within
/// one step of its time differs in length alone.
type Seen = (SystemTime, u64);

impl ChangedFile {
    /// Starts to watch the file at `path`.
    pub fn new(path: &Path) -> Self {
        let mut file = Self { path: path.to_owned(), files: Vec::new() };
        file.list();
        file
    }

    /// Path of the scene file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Returns whether the file, or one that it includes, was modified since the last call. A
    /// missing file counts as unmodified, because editors remove a file for a moment while they
    /// write it.
    pub fn look(&mut self) -> bool {
        let is_changed = |(path, before): &(PathBuf, Option<Seen>)| {
            let now = seen(path);
            now.is_some() && now != *before
        };
        let is_any = self.files.iter().any(is_changed);
        if is_any {
            self.list();
        }
        is_any
    }

    /// Updates the list of files. Files that cannot be read now stay in the list, and so do the
    /// files of the previous list: a scene that is broken for a moment does not name its includes.
    fn list(&mut self) {
        let mut paths = named_files(&self.path);
        let before = self.files.drain(..).map(|(path, _)| path);
        before.for_each(|path| {
            if !paths.contains(&path) {
                paths.push(path);
            }
        });
        let with_state = |path: PathBuf| {
            let state = seen(&path);
            (path, state)
        };
        self.files = paths.into_iter().map(with_state).collect();
    }
}

fn seen(path: &Path) -> Option<Seen> {
    let about = std::fs::metadata(path).ok()?;
    Some((about.modified().ok()?, about.len()))
}
