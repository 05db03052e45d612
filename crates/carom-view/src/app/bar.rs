//! The bar at the top of the window.

use carom_maze::{BUILT_IN_DRAWINGS, Maze, MazeError};
use carom_session::Command;
use egui::{Align, Button, Label, Layout, RichText, Role, Ui, Vec2, WidgetInfo};

use super::{App, Screen};
use crate::action::Action;
use crate::layout::{has_one_menu, is_compact, is_for_fingers, scrolled_within};
use crate::menu::{self, Entry};
use crate::plots;
use crate::watching::PRESETS;

/// Space around the texts of the menus, in points.
const LARGE: Vec2 = Vec2::new(9.0, 5.0);

/// Space between the controls of a narrow bar, in points.
const CLOSE: f32 = 4.0;

/// Shows the contents of a menu; returns the actions of the pressed entries.
type Menu = fn(&mut App, &mut Ui) -> Vec<Action>;

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
        if has_one_menu(ui) {
            if is_compact(ui) {
                ui.horizontal_wrapped(|ui| self.narrow_bar(ui, &mut actions));
            } else {
                ui.horizontal(|ui| self.narrow_bar(ui, &mut actions));
            }
            return actions;
        }
        ui.horizontal(|ui| {
            if !is_for_fingers(ui.ctx()) {
                ui.spacing_mut().button_padding = LARGE;
            }
            self.scenes(ui, "🗁  Scenes", &mut actions);
            for (text, name, show) in Self::MENUS {
                if !self.has_menu(name) {
                    continue;
                }
                let menu = ui.menu_button(text, |ui| show(self, ui));
                let response = menu.response;
                response.widget_info(|| WidgetInfo::labeled(Role::Button, true, name));
                actions.extend(menu.inner.unwrap_or_default());
            }
            ui.separator();
            if let Some(title) = self.title() {
                ui.strong(title);
            }
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                if let Screen::Watching(_) = &self.screen {
                    let is_on = self.shows_inspector();
                    let button = Button::selectable(is_on, "⚙  Settings");
                    let response = ui.add(button).on_hover_text(Action::Inspector.hint());
                    response.widget_info(|| {
                        WidgetInfo::selected(Role::Button, true, is_on, "Settings")
                    });
                    if response.clicked() {
                        actions.push(Action::Inspector);
                    }
                }
            });
        });
        actions
    }

    /// Shows the bar of a narrow window, with all menus in one.
    fn narrow_bar(&mut self, ui: &mut Ui, actions: &mut Vec<Action>) {
        if !is_for_fingers(ui.ctx()) {
            ui.spacing_mut().item_spacing.x = CLOSE;
        }
        self.scenes(ui, "Scenes", actions);
        // An embedded window has no room for a title.
        let is_compact = is_compact(ui);
        if let Some((name, _)) = self.shown().filter(|_| is_compact) {
            ui.strong(name);
            ui.separator();
        }
        let menu = ui.menu_button("Menu", |ui| self.all_menus(ui));
        actions.extend(menu.inner.unwrap_or_default());
        if let Some(title) = self.title().filter(|_| !is_compact) {
            ui.separator();
            ui.add(Label::new(RichText::new(title).strong()).truncate());
        }
    }

    /// The menus beside "Scenes": text with icon, name, and contents.
    const MENUS: [(&'static str, &'static str, Menu); 4] = [
        ("👁  View", "View", Self::view_menu),
        ("📈  Measure", "Measure", Self::measure_menu),
        ("⚑  Maze", "Maze", Self::maze_menu),
        ("⬆  Share", "Share", Self::share_menu),
    ];

    /// Returns whether the present screen has this menu.
    fn has_menu(&self, name: &str) -> bool {
        match name {
            "Maze" => matches!(self.screen, Screen::Maze(_)),
            "Measure" => matches!(self.screen, Screen::Watching(_)),
            _ => true,
        }
    }

    fn scenes(&self, ui: &mut Ui, text: &str, actions: &mut Vec<Action>) {
        let response = ui.button(text).on_hover_text(Action::Choose.hint());
        response.widget_info(|| WidgetInfo::labeled(Role::Button, true, "Scenes"));
        if response.clicked() {
            actions.push(Action::Choose);
        }
    }

    /// Returns the title of the present scene or game.
    fn title(&self) -> Option<String> {
        match &self.screen {
            Screen::Watching(watching) => {
                let scene = &watching.view().scene;
                let title = if scene.title.is_empty() { &scene.name } else { &scene.title };
                Some(title.clone())
            }
            screen => screen.game().map(|game| game.title().to_owned()),
        }
    }

    /// Shows all menus below each other.
    fn all_menus(&mut self, ui: &mut Ui) -> Vec<Action> {
        let height = ui.ctx().content_rect().height() - 2.0 * ui.spacing().interact_size.y;
        let mut actions = Vec::new();
        scrolled_within(height).show(ui, |ui| {
            for (text, name, show) in Self::MENUS {
                if self.has_menu(name) {
                    ui.weak(text);
                    actions.extend(show(self, ui));
                }
            }
        });
        actions
    }

    fn view_menu(&mut self, ui: &mut Ui) -> Vec<Action> {
        let mut entries = match &self.screen {
            Screen::Watching(watching) => watching.cameras(),
            Screen::Maze(_) | Screen::Pinball(_) | Screen::Billiards(_) => PRESETS.to_vec(),
            Screen::Empty => Vec::new(),
        };
        entries.push(Entry::once("Light or dark", Action::Theme));
        entries.push(Entry::once("Keys", Action::Help));
        menu::show(ui, &entries)
    }

    fn measure_menu(&mut self, ui: &mut Ui) -> Vec<Action> {
        let Screen::Watching(watching) = &self.screen else { return Vec::new() };
        menu::show(ui, &watching.measures())
    }

    fn share_menu(&mut self, ui: &mut Ui) -> Vec<Action> {
        let actions = menu::show(
            ui,
            &[
                Entry::once("Picture", Action::Screenshot),
                Entry::switch("Film", Action::Record, self.is_recording()),
                Entry::once("Scene file", Action::Save),
                Entry::once("Link", Action::Link),
            ],
        );
        let Screen::Watching(watching) = &mut self.screen else { return actions };
        if ui.button("Energies as numbers").on_hover_text("Save them as CSV").clicked() {
            watching.wanted = Some(plots::energy_table(watching.view()));
        }
        ui.separator();
        let hash = watching.view().playback.state_hash;
        let mut is_shown = hash.is_some();
        let text = "State hash";
        let tick = ui.checkbox(&mut is_shown, text);
        if tick.on_hover_text("The state as a number, to compare machines").changed() {
            watching.commands.push(Command::ShowStateHash(is_shown));
        }
        if let Some(hash) = hash {
            ui.monospace(hash.to_string());
        }
        actions
    }

    fn maze_menu(&mut self, ui: &mut Ui) -> Vec<Action> {
        match self.mazes(ui) {
            Some(Ok(maze)) => self.play(maze),
            Some(Err(error)) => self.notices.complain(error),
            None => {}
        }
        Vec::new()
    }
}
