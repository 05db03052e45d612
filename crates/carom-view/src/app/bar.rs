//! The bar at the top of the window.

use carom_maze::{BUILT_IN_DRAWINGS, Maze, MazeError};
use egui::Ui;

use super::{App, Screen};
use crate::action::Action;
use crate::layout::{bar_has_one_line, is_for_fingers, scrolled_within};

/// Space between the buttons of the bar, in points; with it all buttons fit into 1280.
const CLOSE: f32 = 4.0;

impl App {
    /// Shows the options of the maze game. Returns another maze if one was chosen.
    fn mazes(&mut self, ui: &mut Ui) -> Option<Result<Maze, MazeError>> {
        let Screen::Maze(screen) = &mut self.screen else { return None };
        let mut levels_back = screen.levels_back();
        if ui.checkbox(&mut levels_back, "Level back").changed()
            && let Err(error) = screen.set_levels_back(levels_back)
        {
            self.notices.complain(error);
        }
        let mut rolls = screen.rolls();
        let friction = "the ball rolls, and no longer slides";
        if ui.checkbox(&mut rolls, "Friction").on_hover_text(friction).changed()
            && let Err(error) = screen.set_rolls(rolls)
        {
            self.notices.complain(error);
        }
        if self.host.offers_tilt()
            && ui.checkbox(&mut self.tilts_device, "Tilt the device").changed()
        {
            self.host.use_tilt(self.tilts_device);
        }
        ui.separator();
        let mut chosen = None;
        if ui.button("Course").clicked() {
            chosen = Some(Maze::course());
        }
        for (name, text) in BUILT_IN_DRAWINGS {
            if ui.button(*name).clicked() {
                chosen = Some(Maze::from_text(text, name));
            }
        }
        if ui.button("Random").on_hover_text("another one each time").clicked() {
            chosen = Some(self.random_maze());
        }
        ui.separator();
        chosen
    }

    fn random_maze(&mut self) -> Result<Maze, MazeError> {
        self.random_mazes += 1;
        Maze::random(self.random_mazes, 8, 6)
    }

    /// Plays the next maze: the course, then the built-in drawings, then random mazes.
    pub(super) fn next_maze(&mut self) {
        let name = self.maze().map(|it| it.game().scene().name.clone()).unwrap_or_default();
        let place = BUILT_IN_DRAWINGS.iter().position(|(drawing, _)| *drawing == name);
        let is_course = Maze::course().is_ok_and(|course| course.scene().name == name);
        let next = match (place, is_course) {
            (Some(place), _) => BUILT_IN_DRAWINGS.get(place + 1),
            (None, true) => BUILT_IN_DRAWINGS.first(),
            (None, false) => None,
        };
        let maze = match next {
            Some((name, text)) => Maze::from_text(text, name),
            None => self.random_maze(),
        };
        match maze {
            Ok(maze) => self.play(maze),
            Err(error) => self.notices.complain(error),
        }
    }

    pub(super) fn bar(&mut self, ui: &mut Ui) -> Vec<Action> {
        let mut actions = Vec::new();
        ui.horizontal_wrapped(|ui| {
            if !is_for_fingers(ui.ctx()) {
                ui.spacing_mut().item_spacing.x = CLOSE;
            }
            if ui.button("Scenes").on_hover_text(Action::Choose.hint()).clicked() {
                actions.push(Action::Choose);
            }
            let name = match &self.screen {
                Screen::Maze(screen) => Some(screen.game().maze().title().to_owned()),
                _ => self.shown().map(|(name, _)| name),
            };
            if let Some(name) = name {
                ui.strong(name);
                ui.separator();
            }
            if bar_has_one_line(ui) {
                let height = ui.ctx().content_rect().height() - 2.0 * ui.spacing().interact_size.y;
                let menu = ui.menu_button("Menu", |ui| {
                    scrolled_within(height).show(ui, |ui| self.switches(ui)).inner
                });
                actions.extend(menu.inner.unwrap_or_default());
            } else {
                actions.extend(self.switches(ui));
            }
        });
        actions
    }

    /// Shows everything in the bar except the choice of a scene.
    fn switches(&mut self, ui: &mut Ui) -> Vec<Action> {
        let mut actions = Vec::new();
        if let Screen::Watching(watching) = &self.screen {
            actions.extend(watching.switches(ui));
            ui.separator();
        }
        match self.mazes(ui) {
            Some(Ok(maze)) => self.play(maze),
            Some(Err(error)) => self.notices.complain(error),
            None => {}
        }
        for (text, action) in [
            ("Picture", Action::Screenshot),
            ("Film", Action::Record),
            ("Save", Action::Save),
            ("Link", Action::Link),
            ("Light/dark", Action::Theme),
            ("Keys", Action::Help),
        ] {
            if ui.button(text).on_hover_text(action.hint()).clicked() {
                actions.push(action);
            }
        }
        actions
    }
}
