//! The whole interface.

mod bar;
mod choosing;
mod files;
mod links;
mod opening;
mod saving;

use std::sync::Arc;
use std::time::Duration;

use carom_maze::Maze;
use carom_render::Quality;
use carom_scene::scene::Scene;
use carom_scene::{Budget, Library, Source};
use carom_session::{Command, Link, SessionError};
use eframe::CreationContext;
use egui::{Context, Pos2, Rect, Theme, Ui};

use crate::action::{self, Action};
use crate::address::Address;
use crate::billiards_screen::BilliardsScreen;
use crate::chooser::{Asked, Chooser, invite};
use crate::exports::Exports;
use crate::fonts;
use crate::game_view::{GameScreen, Wish};
use crate::help;
use crate::host::{Host, Inbox};
use crate::layout::{accept_slow_clicks, suit_fingers};
use crate::link_dialog::LinkDialog;
use crate::maze_screen::MazeScreen;
use crate::notices::Notices;
use crate::pinball_screen::PinballScreen;
use crate::saved::{Panels, SavedValues};
use crate::studio::Studio;
use crate::theme::make_readable;
use crate::watching::{Manner, Watching};

/// What the interface needs at the start.
pub struct Setup {
    /// The scenes to choose from.
    pub library: Library,
    /// What to open first; `None` opens the chooser.
    pub start: Option<Start>,
    /// The program that hosts the interface.
    pub host: Box<dyn Host>,
    /// Quality of the pictures on the screen.
    pub quality: Quality,
    /// Longest time for the physics in a frame, on the thread of the interface; `None` gives it a thread of its own.
    pub inline_budget: Option<Duration>,
    /// Limits on the work that a link may cause.
    pub link_budget: Budget,
}

/// What to open first.
#[derive(Debug, Clone)]
pub enum Start {
    /// A scene to watch.
    Scene(Box<Scene>, Source),
    /// A maze to play.
    Maze(Box<Maze>),
    /// A pinball table to play on.
    Pinball(Box<carom_pinball::Table>),
    /// A table to play nine-ball on.
    Billiards(Box<carom_billiards::Table>),
    /// The run of a link.
    Link(Box<Link>),
}

/// The interface: hosted by a window, a page or a test.
pub struct App {
    context: Context,
    library: Library,
    host: Box<dyn Host>,
    inbox: Inbox,
    inline_budget: Option<Duration>,
    link_budget: Budget,
    studio: Studio,
    screen: Screen,
    chooser: Chooser,
    notices: Notices,
    help: bool,
    /// Whether the scene plays on once the chooser is closed.
    resumes: bool,
    /// Processor time for the last frame of the interface \[s\].
    cpu_seconds: Option<f32>,
    /// The last error of the physics that has a notice.
    told: Option<Arc<SessionError>>,
    /// Whether tilting the device tilts mazes.
    tilts_device: bool,
    /// Seed of the last random maze.
    random_mazes: u64,
    exports: Exports,
    address: Address,
    link: LinkDialog,
    saved: SavedValues,
}

/// The content of the window.
enum Screen {
    Empty,
    Watching(Box<Watching>),
    Maze(Box<MazeScreen>),
    Pinball(Box<PinballScreen>),
    Billiards(Box<BilliardsScreen>),
}

impl App {
    /// Makes the interface on the graphics device of its host.
    ///
    /// # Errors
    /// A message for the user if the host does not draw with wgpu.
    pub fn new(host: &CreationContext, setup: Setup) -> Result<Self, String> {
        let state = host.wgpu_render_state.clone();
        let state = state.ok_or("the interface needs a host that draws with wgpu")?;
        let mut saved = SavedValues::load(host.storage);
        if setup.host.is_embedded() {
            saved.layout.panels = Panels::NONE;
        }
        let mut app = Self {
            context: host.egui_ctx.clone(),
            library: setup.library,
            host: setup.host,
            inbox: Inbox::new(host.egui_ctx.clone()),
            inline_budget: setup.inline_budget,
            link_budget: setup.link_budget,
            studio: Studio::new(state, setup.quality),
            screen: Screen::Empty,
            chooser: Chooser::default(),
            notices: Notices::default(),
            help: false,
            resumes: false,
            cpu_seconds: None,
            told: None,
            tilts_device: false,
            random_mazes: 0,
            exports: Exports::default(),
            address: Address::default(),
            link: LinkDialog::default(),
            saved,
        };
        fonts::install(&app.context);
        make_readable(&app.context);
        accept_slow_clicks(&app.context);
        if app.host.has_coarse_pointer() {
            suit_fingers(&app.context);
        }
        match setup.start {
            Some(Start::Scene(scene, source)) => app.watch(*scene, source),
            Some(Start::Maze(maze)) => app.play(*maze),
            Some(Start::Pinball(table)) => {
                let link = Link::to_scene(table.scene());
                app.play_pinball(*table, link);
            }
            Some(Start::Billiards(table)) => {
                let link = Link::to_scene(table.scene());
                app.play_billiards(*table, link);
            }
            Some(Start::Link(link)) => app.follow(&link),
            None => app.welcome(),
        }
        Ok(app)
    }

    /// Returns the watched scene, if there is one.
    pub fn watching(&self) -> Option<&Watching> {
        match &self.screen {
            Screen::Watching(watching) => Some(watching),
            _ => None,
        }
    }

    /// Sends a command to the physics of the watched scene.
    pub fn command(&mut self, command: Command) {
        if let Screen::Watching(watching) = &mut self.screen {
            watching.commands.push(command);
        }
    }

    /// Returns the position on the screen of the sphere at an index, for a picture that fills
    /// `picture`.
    pub fn place_of(&self, index: usize, picture: Rect) -> Option<Pos2> {
        self.watching()?.place_of(index, picture)
    }

    /// Returns the radius on the screen of the sphere at an index, in points, for a picture that
    /// fills `picture`.
    pub fn radius_of(&self, index: usize, picture: Rect) -> Option<f32> {
        self.watching()?.radius_of(index, picture)
    }

    /// Returns the game, if a maze is played.
    pub fn maze(&self) -> Option<&MazeScreen> {
        match &self.screen {
            Screen::Maze(screen) => Some(screen),
            _ => None,
        }
    }

    /// Returns the game, if pinball is played.
    pub fn pinball(&self) -> Option<&PinballScreen> {
        match &self.screen {
            Screen::Pinball(screen) => Some(screen),
            _ => None,
        }
    }

    /// Returns the game, if nine-ball is played.
    pub fn billiards(&self) -> Option<&BilliardsScreen> {
        match &self.screen {
            Screen::Billiards(screen) => Some(screen),
            _ => None,
        }
    }

    /// Returns the game, if nine-ball is played, to make moves in it.
    pub fn billiards_mut(&mut self) -> Option<&mut BilliardsScreen> {
        match &mut self.screen {
            Screen::Billiards(screen) => Some(screen),
            _ => None,
        }
    }

    /// Returns the scenes to choose from.
    pub fn library(&self) -> &Library {
        &self.library
    }

    /// Returns whether the chooser is open.
    pub fn is_choosing(&self) -> bool {
        self.chooser.is_open()
    }

    /// Returns whether a film is being recorded.
    pub fn is_recording(&self) -> bool {
        self.exports.is_recording()
    }

    /// Returns the processor time for the last frame of the interface \[s\]; `None` before the
    /// first.
    pub fn cpu_seconds(&self) -> Option<f32> {
        self.cpu_seconds
    }

    /// Returns the messages for the user.
    pub fn notices(&self) -> &Notices {
        &self.notices
    }

    /// Performs the action of a key or button.
    pub fn act(&mut self, action: Action) {
        let is_panel = matches!(action, Action::Inspector | Action::Plots | Action::Impacts);
        if is_panel && self.chooser.is_strip() {
            // Panels have their place once the strip is closed.
            self.chooser.close_all();
            if action == Action::Inspector && self.shows_inspector() {
                return;
            }
        }
        match action {
            Action::Choose => self.open_chooser(),
            Action::Help => self.help ^= true,
            Action::Theme => {
                let dark = self.context.theme() == Theme::Dark;
                self.context.set_theme(if dark { Theme::Light } else { Theme::Dark });
            }
            Action::Close => {
                self.stop_seeking();
                self.help = false;
                self.link.close();
                self.chooser.close();
                self.notices.clear();
            }
            Action::Screenshot => self.screenshot(),
            Action::Record => self.record(),
            Action::Save => self.save(),
            Action::Link => self.open_link(),
            _ => match &mut self.screen {
                Screen::Watching(watching) => watching.act(action),
                screen => {
                    if let Some(game) = screen.game_mut() {
                        game.act(action);
                    }
                }
            },
        }
    }

    /// Returns whether the inspector is in the window.
    fn shows_inspector(&self) -> bool {
        !self.chooser.is_strip() && self.watching().is_some_and(Watching::shows_inspector)
    }

    /// Stops a seek at the time reached, unless a dialog is open that the key is for.
    fn stop_seeking(&mut self) {
        let has_dialog = self.help || self.link.is_open() || self.chooser.is_open();
        if !has_dialog && self.watching().is_some_and(|it| it.view().seeking.is_some()) {
            self.command(Command::StopSeeking);
        }
    }

    /// Returns the settings of the interface that pictures depend on.
    fn manner(&self) -> Manner {
        let recording = self.exports.is_recording();
        let has_card = !self.chooser.is_strip();
        Manner { dark: self.context.theme() == Theme::Dark, recording, has_card }
    }

    /// Returns the name of the present scene and its time \[s\].
    fn shown(&self) -> Option<(String, f64)> {
        match &self.screen {
            Screen::Watching(watching) => {
                Some((watching.view().scene.name.clone(), watching.view().time))
            }
            screen => screen.game().map(|game| (game.scene().name.clone(), game.elapsed())),
        }
    }

    /// Shows errors of the physics as notices.
    fn complain_of_session(&mut self) {
        let Screen::Watching(watching) = &mut self.screen else { return };
        if let Some(error) = watching.refused.take() {
            self.notices.complain(error);
        }
        let error = watching.view().playback.error.clone();
        // Each error gets one notice; it stays in the view until a step succeeds.
        let is_told = match (&error, &self.told) {
            (Some(error), Some(told)) => Arc::ptr_eq(error, told),
            _ => false,
        };
        if let Some(error) = error.as_ref().filter(|_| !is_told) {
            self.notices.complain(error);
        }
        self.told = error;
    }

    /// Shows errors of the graphics device as notices. The scene continues and can be saved.
    fn complain_of_studio(&mut self) {
        if let Some(text) = self.studio.failure() {
            let advice = "Save the scene with Ctrl + S, and start anew.";
            self.notices.complain(format!("{text}. {advice}"));
        }
    }

    fn screen(&mut self, ui: &mut Ui) {
        let manner = self.manner();
        let margin = egui::Frame::NONE.fill(ui.visuals().panel_fill);
        let (mut wish, mut wanted, mut asked) = (None, None, None);
        let is_strip = self.chooser.is_strip();
        match &mut self.screen {
            Screen::Empty => {
                egui::CentralPanel::default().show(ui, |ui| {
                    ui.centered_and_justified(|ui| ui.weak("Press Enter to choose a scene."));
                });
            }
            Screen::Watching(watching) => {
                for action in watching.transport(ui, manner) {
                    watching.act(action);
                }
                asked = self.chooser.show_strip(ui, &mut self.studio);
                // The first picture has the full width.
                if !is_strip {
                    watching.panels(ui);
                }
                wanted = watching.wanted.take();
                self.saved.layout = watching.layout();
                let studio = &mut self.studio;
                let shown = egui::CentralPanel::default()
                    .frame(margin)
                    .show(ui, |ui| watching.picture(ui, studio, manner));
                if is_strip {
                    invite(ui, shown.response.rect);
                }
                shown.inner.into_iter().for_each(|action| watching.act(action));
            }
            screen => {
                if let Some(game) = screen.game_mut() {
                    let studio = &mut self.studio;
                    wish = egui::CentralPanel::default()
                        .frame(margin)
                        .show(ui, |ui| game.picture(ui, studio, manner.dark))
                        .inner;
                }
            }
        }
        if let Some(wanted) = wanted {
            self.save_plots(wanted);
        }
        match asked {
            Some(Asked::All) => self.open_chooser(),
            Some(Asked::Chosen(chosen)) => self.take(chosen),
            None => {}
        }
        match wish {
            Some(Wish::Watch) => self.watch_game(),
            Some(Wish::Next) => self.next_maze(),
            None => {}
        }
    }

    fn advance(&mut self, ui: &Ui) {
        match &mut self.screen {
            Screen::Empty => {}
            Screen::Watching(watching) => watching.advance(ui),
            // The game pauses behind the dialog.
            Screen::Maze(_) | Screen::Pinball(_) | Screen::Billiards(_)
                if self.chooser.is_open() => {}
            Screen::Maze(screen) => {
                screen.stick = self.host.stick();
                let steering = screen.steering(ui);
                if let Err(error) = screen.advance(ui, steering) {
                    self.notices.complain(error);
                }
            }
            Screen::Pinball(screen) => {
                if let Err(error) = screen.advance(ui) {
                    self.notices.complain(error);
                }
            }
            Screen::Billiards(screen) => {
                if let Err(error) = screen.advance(ui) {
                    self.notices.complain(error);
                }
            }
        }
    }
}

impl Screen {
    /// Returns the game that is played.
    fn game(&self) -> Option<&dyn GameScreen> {
        match self {
            Self::Maze(screen) => Some(&**screen),
            Self::Pinball(screen) => Some(&**screen),
            Self::Billiards(screen) => Some(&**screen),
            Self::Empty | Self::Watching(_) => None,
        }
    }

    /// Returns the game that is played, to change it.
    fn game_mut(&mut self) -> Option<&mut dyn GameScreen> {
        match self {
            Self::Maze(screen) => Some(&mut **screen),
            Self::Pinball(screen) => Some(&mut **screen),
            Self::Billiards(screen) => Some(&mut **screen),
            Self::Empty | Self::Watching(_) => None,
        }
    }
}

impl eframe::App for App {
    fn save(&mut self, storage: &mut dyn eframe::Storage) {
        self.keep_game();
        self.saved.save(storage);
    }

    fn auto_save_interval(&self) -> std::time::Duration {
        // A web page may close without notice, so the state is saved every few seconds.
        std::time::Duration::from_secs(5)
    }

    fn ui(&mut self, ui: &mut Ui, frame: &mut eframe::Frame) {
        self.cpu_seconds = frame.info().cpu_usage;
        let context = ui.ctx().clone();
        self.studio.begin_frame();
        // A dialog takes the keys; on the last screen Enter starts again, and in the strip it chooses.
        let is_over = self.screen.game().is_some_and(|it| it.last_screen().is_some());
        let is_taken = is_over || self.chooser.has_focus();
        if !self.chooser.is_open() {
            for action in action::pressed(&context, is_taken) {
                self.act(action);
            }
        }
        self.open_dropped();
        self.reload_changed();
        self.advance(ui);
        self.export();
        self.complain_of_session();
        self.complain_of_studio();
        let asked = egui::Panel::top("bar").show(ui, |ui| self.bar(ui)).inner;
        self.screen(ui);
        for action in asked {
            self.act(action);
        }
        self.choose(&context);
        let game = match &self.screen {
            Screen::Maze(_) => Some(&action::MAZE),
            Screen::Pinball(_) => Some(&action::PINBALL),
            Screen::Billiards(_) => Some(&action::BILLIARDS),
            Screen::Watching(_) | Screen::Empty => None,
        };
        help::show(&context, &mut self.help, game);
        self.links();
        self.drop_target();
        self.notices.show(ui);
    }
}
