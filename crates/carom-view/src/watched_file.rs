//! Watches a scene file for changes on the disk.

use std::path::PathBuf;

use carom_scene::{ChangedFile, Source};

/// Time between two checks of the file \[s\].
pub const INTERVAL: f64 = 0.5;

/// The file of the watched scene.
#[derive(Debug, Default)]
pub struct WatchedFile {
    file: Option<ChangedFile>,
    /// Time of the last check, by the clock of the interface \[s\].
    looked: f64,
}

impl WatchedFile {
    /// Watches the file of a scene; stops watching if the scene comes from no file.
    pub fn watch(&mut self, source: &Source) {
        self.file = match source {
            Source::File(path) => Some(ChangedFile::new(path)),
            _ => None,
        };
    }

    /// Returns whether a file is watched.
    pub fn is_any(&self) -> bool {
        self.file.is_some()
    }

    /// Returns the file once after it changed.
    pub fn changed(&mut self, now: f64) -> Option<PathBuf> {
        if now - self.looked < INTERVAL {
            return None;
        }
        self.looked = now;
        let file = self.file.as_mut()?;
        file.look().then(|| file.path().to_owned())
    }
}
