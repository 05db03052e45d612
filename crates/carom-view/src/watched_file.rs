//! A scene file that is edited while it is watched.

use std::path::PathBuf;

use carom_scene::{ChangedFile, Source};

/// How often the file is looked at \[s\].
pub const INTERVAL: f64 = 0.5;

/// The file of the scene that is watched.
#[derive(Debug, Default)]
pub struct WatchedFile {
    file: Option<ChangedFile>,
    /// When it was looked at last, by the clock of the interface \[s\].
    looked: f64,
}

impl WatchedFile {
    /// Watches the file of a scene; none for a scene that comes from elsewhere.
    pub fn watch(&mut self, source: &Source) {
        self.file = match source {
            Source::File(path) => Some(ChangedFile::new(path)),
            _ => None,
        };
    }

    /// Whether there is a file to watch.
    pub fn is_any(&self) -> bool {
        self.file.is_some()
    }

    /// The file, once, if it was changed since it was looked at last.
    pub fn changed(&mut self, now: f64) -> Option<PathBuf> {
        if now - self.looked < INTERVAL {
            return None;
        }
        self.looked = now;
        let file = self.file.as_mut()?;
        file.look().then(|| file.path().to_owned())
    }
}
