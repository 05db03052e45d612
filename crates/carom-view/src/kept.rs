//! What the interface keeps from start to start: layout, marks, files opened last, a game.

use std::path::{Path, PathBuf};

use carom_maze::Progress;
use eframe::Storage;
use serde::{Deserialize, Serialize};

use crate::look::Marks;
use crate::plots;

/// Under this it is found again.
const KEY: &str = "carom";

/// Files that are remembered.
const MOST_RECENT: usize = 6;

/// What is kept from start to start, and from scene to scene.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Kept {
    /// How scenes are shown.
    pub layout: Layout,
    /// Scene files opened last, the last one first.
    pub recent: Vec<PathBuf>,
    /// The game that was played last.
    pub game: Option<KeptGame>,
}

/// A game, to go on with.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct KeptGame {
    /// A link to its maze.
    pub maze: String,
    pub progress: Progress,
    /// Whether the ball rolls by friction.
    pub rolls: bool,
}

/// What is shown of a scene, and around it.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Layout {
    pub panels: Panels,
    pub plots: plots::Shown,
    pub marks: Marks,
}

/// Which panels are open.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Panels {
    pub inspector: bool,
    pub plots: bool,
    pub impacts: bool,
}

impl Panels {
    /// No panel.
    pub const NONE: Self = Self { inspector: false, plots: false, impacts: false };
}

impl Default for Panels {
    fn default() -> Self {
        Self { inspector: true, plots: false, impacts: false }
    }
}

impl Kept {
    /// What was kept; what it is at first where nothing was, or nothing that can be read.
    pub fn load(storage: Option<&dyn Storage>) -> Self {
        storage.and_then(|storage| eframe::get_value(storage, KEY)).unwrap_or_default()
    }

    /// Keeps it.
    pub fn save(&self, storage: &mut dyn Storage) {
        eframe::set_value(storage, KEY, self);
    }

    /// Remembers a file that was opened.
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
        let mut kept = Kept::default();
        for name in ["/a.toml", "/b.toml", "/a.toml"] {
            kept.remember(Path::new(name));
        }
        assert_eq!(kept.recent, [PathBuf::from("/a.toml"), PathBuf::from("/b.toml")]);
        (0..20).for_each(|i| kept.remember(Path::new(&format!("/{i}.toml"))));
        assert_eq!(kept.recent.len(), MOST_RECENT);
    }
}
