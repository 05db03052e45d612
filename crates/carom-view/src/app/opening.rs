//! Opens scenes, and games in scenes.

use carom_maze::Maze;
use carom_scene::Source;
use carom_scene::scene::Scene;
use carom_session::Link;

use super::{App, Screen, Start};
use crate::billiards_screen::BilliardsScreen;
use crate::maze_screen::MazeScreen;
use crate::pinball_screen::PinballScreen;
use crate::watching::Watching;
use crate::written_scene::WrittenScene;

impl Start {
    /// Returns the start of the game in a scene; `None` if the scene is no game.
    pub fn game(scene: &Scene) -> Option<Self> {
        let maze = || Maze::from_scene(scene).ok().map(|it| Self::Maze(Box::new(it)));
        let pinball = || {
            let table = carom_pinball::Table::from_scene(scene).ok();
            table.map(|it| Self::Pinball(Box::new(it)))
        };
        let billiards = || {
            let table = carom_billiards::Table::from_scene(scene).ok();
            table.map(|it| Self::Billiards(Box::new(it)))
        };
        maze().or_else(pinball).or_else(billiards)
    }
}

impl App {
    /// Opens a scene: plays a game, watches any other scene.
    pub(super) fn open(&mut self, scene: Scene, source: Source) {
        if !self.play_scene(&scene, || Link::to_scene(&scene)) {
            self.watch(scene, source);
        }
    }

    /// Plays a scene if it is a game; returns whether it is one. `link` makes the link to it.
    pub(super) fn play_scene(&mut self, scene: &Scene, link: impl FnOnce() -> Link) -> bool {
        match Start::game(scene) {
            Some(Start::Maze(maze)) => self.play_maze(*maze, link()),
            Some(Start::Pinball(table)) => self.play_pinball(*table, link()),
            Some(Start::Billiards(table)) => self.play_billiards(*table, link()),
            _ => return false,
        }
        true
    }

    /// Watches a scene; shows an error if that is impossible.
    pub fn watch(&mut self, scene: Scene, source: Source) {
        match Watching::new(scene, source, self.inline_budget, &self.context) {
            Ok(mut watching) => {
                self.host.watch(&watching.source);
                // A web page cannot reopen files.
                if let Source::File(path) = &watching.source
                    && cfg!(not(target_arch = "wasm32"))
                {
                    self.saved.remember(path);
                    if let Ok(written) = WrittenScene::from_file(path, Vec::new()) {
                        watching.set_written(written);
                    }
                }
                watching.set_layout(self.saved.layout);
                self.show(Screen::Watching(Box::new(watching)));
            }
            Err(error) => self.notices.complain(error),
        }
    }

    /// Plays a maze.
    pub fn play(&mut self, maze: Maze) {
        let link = Link::to_scene(maze.scene());
        self.play_maze(maze, link);
    }

    fn play_maze(&mut self, maze: Maze, link: Link) {
        match MazeScreen::new(maze, link) {
            Ok(screen) => self.begin(Screen::Maze(Box::new(screen))),
            Err(error) => self.notices.complain(error),
        }
    }

    pub(super) fn play_pinball(&mut self, table: carom_pinball::Table, link: Link) {
        match PinballScreen::new(table, link) {
            Ok(screen) => self.begin(Screen::Pinball(Box::new(screen))),
            Err(error) => self.notices.complain(error),
        }
    }

    pub(super) fn play_billiards(&mut self, table: carom_billiards::Table, link: Link) {
        match BilliardsScreen::new(table, link) {
            Ok(screen) => self.begin(Screen::Billiards(Box::new(screen))),
            Err(error) => self.notices.complain(error),
        }
    }

    /// Begins a game, or continues an earlier one.
    fn begin(&mut self, mut screen: Screen) {
        self.keep_game();
        if let Some(game) = screen.game_mut() {
            if let Some(saved) = self.saved.game(&game.view().link) {
                game.resume(saved);
            }
            self.host.show_link(&game.view().link);
        }
        self.show(screen);
    }

    /// Watches the present game as a scene.
    pub(super) fn watch_game(&mut self) {
        if let Some(game) = self.screen.game() {
            self.watch(game.scene().clone(), Source::Registered);
        }
    }

    /// Remembers the present game.
    pub(super) fn keep_game(&mut self) {
        if let Some(game) = self.screen.game()
            && let Some(saved) = game.saved()
        {
            self.saved.keep_game(&game.view().link, saved);
        }
    }

    /// Replaces the content of the window; ends a film of the old content.
    pub(super) fn show(&mut self, screen: Screen) {
        self.keep_game();
        self.notices.clear();
        self.chooser.close_all();
        self.resumes = false;
        self.exports.end_film();
        self.screen = screen;
    }
}
