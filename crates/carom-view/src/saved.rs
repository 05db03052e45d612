//! Values kept between starts: layout, marks, recent files, a game.

use std::path::{Path, PathBuf};

use carom_maze::Progress;
use eframe::Storage;
use serde::{Deserialize, Serialize};

use crate::look::Marks;
use crate::plots;

/// Key of these values in the storage.
const KEY: &str = "carom";

/// Largest number of recent files.
const MOST_RECENT: usize = 6;

/// Values kept between starts and between scenes.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct SavedValues {
    /// Layout of scenes.
    pub layout: Layout,
    /// Recent scene files, newest first.
    pub recent: Vec<PathBuf>,
    /// The last game.
    pub game: Option<SavedGame>,
}

/// A game that can be continued.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SavedGame {
    /// A link to its maze.
    pub maze: String,
    pub progress: Progress,
    /// Whether the ball rolls by friction.
    pub rolls: bool,
}

/// The visible parts of a scene and around it.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Layout {
    pub panels: Panels,
    pub plots: plots::PlotChoice,
    pub marks: Marks,
}

/// The open panels.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Panels {
    pub inspector: bool,
    pub plots: bool,
    pub impacts: bool,
}

impl Panels {
    /// No open panel.
    pub const NONE: Self = Self { inspector: false, plots: false, impacts: false };
}

impl Default for Panels {
    fn default() -> Self {
        Self { inspector: true, plots: false, impacts: false }
    }
}

impl SavedValues {
    /// Reads the values from the storage; returns the defaults if there are none or they cannot be
    /// read.
    pub fn load(storage: Option<&dyn Storage>) -> Self {
        storage.and_then(|storage| eframe::get_value(storage, KEY)).unwrap_or_default()
    }

    /// Writes the values to the storage.
    pub fn save(&self, storage: &mut dyn Storage) {
        eframe::set_value(storage, KEY, self);
    }

    /// Adds a file to the recent ones.
    pub fn remember(&mut self, path: &Path) {
        let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
        self.recent.retain(|it| *it != path);
        self.recent.insert(0, path);
        self.recent.truncate(MOST_RECENT);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_opened_again_is_the_first_and_there_only_once() {
        let mut kept = SavedValues::default();
        for name in ["/a.toml", "/b.toml", "/a.toml"] {
            kept.remember(Path::new(name));
        }
        assert_eq!(kept.recent, [PathBuf::from("/a.toml"), PathBuf::from("/b.toml")]);
        (0..20).for_each(|i| kept.remember(Path::new(&format!("/{i}.toml"))));
        assert_eq!(kept.recent.len(), MOST_RECENT);
    }
}
