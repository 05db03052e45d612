//! A file that is edited while it is in use.

use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// A file, and when it was changed last.
#[derive(Debug, Clone)]
pub struct ChangedFile {
    path: PathBuf,
    changed: Option<SystemTime>,
}

impl ChangedFile {
    /// A file as it is now.
    pub fn new(path: &Path) -> Self {
        Self { path: path.to_owned(), changed: changed(path) }
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Whether it was changed since it was looked at last. While an editor writes it anew, it may be
    /// missing for a moment, which is no change.
    pub fn look(&mut self) -> bool {
        let now = changed(&self.path);
        if now.is_none() || now == self.changed {
            return false;
        }
        self.changed = now;
        true
    }
}

fn changed(path: &Path) -> Option<SystemTime> {
    std::fs::metadata(path).and_then(|about| about.modified()).ok()
}
