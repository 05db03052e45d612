//! A file that is waited for to change.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, SystemTime};

/// How often it is looked at.
const INTERVAL: Duration = Duration::from_millis(200);

/// A file, and when it was changed last.
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

    /// Waits until it is changed, or until `interrupted`. Returns whether it was changed. While an
    /// editor writes it anew, it may be missing.
    pub fn wait(&mut self, interrupted: &AtomicBool) -> bool {
        while !interrupted.load(Ordering::Relaxed) {
            let now = changed(&self.path);
            if now.is_some() && now != self.changed {
                self.changed = now;
                return true;
            }
            std::thread::sleep(INTERVAL);
        }
        false
    }
}

fn changed(path: &Path) -> Option<SystemTime> {
    std::fs::metadata(path).and_then(|about| about.modified()).ok()
}
