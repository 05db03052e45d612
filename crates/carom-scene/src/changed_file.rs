//! A scene file that is edited while it is in use.

use std::path::{Path, PathBuf};
use std::time::SystemTime;

use crate::text::named_files;

/// A scene file and those that it includes, and when they were changed last.
#[derive(Debug, Clone)]
pub struct ChangedFile {
    path: PathBuf,
    files: Vec<(PathBuf, Option<SystemTime>)>,
}

impl ChangedFile {
    /// A file as it is now.
    pub fn new(path: &Path) -> Self {
        let mut file = Self { path: path.to_owned(), files: Vec::new() };
        file.list();
        file
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Whether it, or one that it includes, was changed since it was looked at last. While an editor
    /// writes a file anew, it may be missing for a moment, which is no change.
    pub fn look(&mut self) -> bool {
        let is_changed = |(path, before): &(PathBuf, Option<SystemTime>)| {
            let now = changed(path);
            now.is_some() && now != *before
        };
        let is_any = self.files.iter().any(is_changed);
        if is_any {
            self.list();
        }
        is_any
    }

    /// Lists the files anew: also those that cannot be read now, and those that were listed last, which
    /// a file that is broken for a moment does not name.
    fn list(&mut self) {
        let mut paths = named_files(&self.path);
        let before = self.files.drain(..).map(|(path, _)| path);
        before.for_each(|path| {
            if !paths.contains(&path) {
                paths.push(path);
            }
        });
        let dated = |path: PathBuf| {
            let changed = changed(&path);
            (path, changed)
        };
        self.files = paths.into_iter().map(dated).collect();
    }
}

fn changed(path: &Path) -> Option<SystemTime> {
    std::fs::metadata(path).and_then(|about| about.modified()).ok()
}
