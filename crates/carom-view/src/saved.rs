//! Values kept between starts: layout, marks, recent files, games.

use std::path::{Path, PathBuf};

use carom_maze::Progress;
use carom_session::Link;
use eframe::Storage;
use serde::{Deserialize, Serialize};

use crate::look::Marks;
use crate::plots;

/// Key of these values in the storage.
const KEY: &str = "carom";

/// Largest number of recent files.
const MOST_RECENT: usize = 6;

/// Largest number of games.
const MOST_GAMES: usize = 12;

/// Values kept between starts and between scenes.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct SavedValues {
    /// Layout of scenes.
    pub layout: Layout,
    /// Recent scene files, newest first.
    pub recent: Vec<PathBuf>,
    /// Links to games without the results to beat, and what is kept of the games; the last game first.
    pub games: Vec<(String, SavedGame)>,
}

/// What is kept of a game.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum SavedGame {
    /// A game in a maze, which can be continued.
    Maze {
        progress: Progress,
        /// Whether the ball rolls by friction.
        rolls: bool,
        /// Text of the moves that reached the best time.
        #[serde(default)]
        moves: Option<String>,
    },
    /// Games on a pinball table.
    Pinball {
        /// The most points of a game.
        best: u64,
        /// Text of the keys that reached them.
        #[serde(default)]
        keys: Option<String>,
    },
    /// Racks of nine-ball.
    Billiards {
        /// Number of players.
        players: usize,
        /// Fewest strokes of a rack of one player alone, and the moves, one a line.
        best: Option<(u32, String)>,
    },
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
        let text = storage.and_then(|storage| storage.get_string(KEY));
        text.and_then(|text| serde_json::from_str(&text).ok()).unwrap_or_default()
    }

    /// Writes the values to the storage.
    pub fn save(&self, storage: &mut dyn Storage) {
        // Texts, numbers and lists are written without errors.
        storage.set_string(KEY, serde_json::to_string(self).unwrap_or_default());
    }

    /// Keeps a game, and forgets the oldest of too many.
    pub fn keep_game(&mut self, link: &Link, game: SavedGame) {
        let link = link.clone().without_goal().to_string();
        self.games.retain(|(it, _)| *it != link);
        self.games.insert(0, (link, game));
        self.games.truncate(MOST_GAMES);
    }

    /// Returns what was kept of the game of a link.
    pub fn game(&self, link: &Link) -> Option<&SavedGame> {
        let link = link.clone().without_goal().to_string();
        self.games.iter().find(|(it, _)| *it == link).map(|(_, game)| game)
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

    #[test]
    fn each_game_is_kept_once_with_or_without_a_result_to_beat() {
        let link = |name: &str| Link::parse(&format!("scene={name}")).expect("a link");
        let mut kept = SavedValues::default();
        for (name, best) in [("pinball", 10), ("table", 20), ("pinball", 30)] {
            kept.keep_game(&link(name), SavedGame::Pinball { best, keys: None });
        }
        let challenge = link("pinball").with_goal(500.0).expect("a goal");
        assert_eq!(kept.game(&challenge), Some(&SavedGame::Pinball { best: 30, keys: None }));
        assert_eq!(kept.game(&link("table")), Some(&SavedGame::Pinball { best: 20, keys: None }));
        assert_eq!((kept.games.len(), kept.game(&link("maze"))), (2, None));
        (0..20).for_each(|i| {
            kept.keep_game(&link(&format!("t{i}")), SavedGame::Pinball { best: 0, keys: None })
        });
        assert_eq!(kept.games.len(), MOST_GAMES);
    }

    /// A storage in memory.
    #[derive(Default)]
    struct Texts(std::collections::BTreeMap<String, String>);

    impl Storage for Texts {
        fn get_string(&self, key: &str) -> Option<String> {
            self.0.get(key).cloned()
        }

        fn set_string(&mut self, key: &str, value: String) {
            self.0.insert(key.to_owned(), value);
        }

        fn remove_string(&mut self, key: &str) {
            self.0.remove(key);
        }

        fn flush(&mut self) {}
    }

    #[test]
    fn values_come_back_from_a_storage_and_what_is_no_value_is_forgotten() {
        let mut kept = SavedValues::default();
        kept.layout.panels.impacts = true;
        kept.remember(Path::new("/a.toml"));
        let link = Link::parse("scene=nine-ball").expect("a link");
        kept.keep_game(&link, SavedGame::Billiards { players: 2, best: Some((9, "a\n".into())) });
        let mut storage = Texts::default();
        kept.save(&mut storage);
        assert_eq!(SavedValues::load(Some(&storage)), kept);
        storage.set_string(KEY, "(layout:".to_owned());
        assert_eq!(SavedValues::load(Some(&storage)), SavedValues::default());
    }
}
