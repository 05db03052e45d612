//! The interface as a whole.

mod bar;
mod files;
mod links;
mod saving;

use std::sync::Arc;

use carom_maze::Maze;
use carom_render::Quality;
use carom_scene::scene::Scene;
use carom_scene::{Budget, Library, Source};
use carom_session::{Command, Link, SessionError};
use eframe::CreationContext;
use egui::{Context, Pos2, Rect, Theme, Ui};

use crate::action::{self, Action};
use crate::address::Address;
use crate::chooser::{Chooser, Chosen};
use crate::exports::Exports;
use crate::help;
use crate::host::{Host, Inbox, ReadFile};
use crate::kept::{Kept, Panels};
use crate::layout::suit_fingers;
use crate::link_dialog::LinkDialog;
use crate::maze_screen::{MazeScreen, Wish};
use crate::notices::Notices;
use crate::orbit::Preset;
use crate::studio::Studio;
use crate::theme::make_readable;
use crate::watching::{Manner, Watching};
use crate::written_scene::WrittenScene;

/// What the interface starts with.
pub struct Setup {
    /// All scenes that can be chosen.
    pub library: Library,
    /// What is open at the start; the chooser without it.
    pub start: Option<Start>,
    /// The program that it runs in.
    pub host: Box<dyn Host>,
    /// How much work goes into the pictures on the screen.
    pub quality: Quality,
    /// Whether the physics has a thread of its own.
    pub threaded: bool,
    /// How much a link may ask for.
    pub link_budget: Budget,
}

/// What is open at the start.
#[derive(Debug, Clone)]
pub enum Start {
    /// A scene to watch.
    Scene(Box<Scene>, Source),
    /// A maze to play.
    Maze(Box<Maze>),
    /// The run of a link.
    Link(Box<Link>),
}

/// The interface: hosted by a window, a page or a test.
pub struct App {
    context: Context,
    library: Library,
    host: Box<dyn Host>,
    inbox: Inbox,
    threaded: bool,
    link_budget: Budget,
    studio: Studio,
    screen: Screen,
    chooser: Chooser,
    notices: Notices,
    help: bool,
    /// Time of the processor for the last picture of the interface \[s\].
    cpu_seconds: Option<f32>,
    /// What went wrong in the physics and stands in a notice.
    told: Option<Arc<SessionError>>,
    /// Whether mazes are tilted by tilting the device.
    tilts_device: bool,
    /// Seed of the last random maze.
    random_mazes: u64,
    exports: Exports,
    address: Address,
    link: LinkDialog,
    kept: Kept,
}

/// What fills the window.
enum Screen {
    Empty,
    Watching(Box<Watching>),
    Maze(Box<MazeScreen>),
}

impl App {
    /// The interface, on the graphics device of its host.
    ///
    /// # Errors
    /// A message for people if the host draws without wgpu.
    pub fn new(host: &CreationContext, setup: Setup) -> Result<Self, String> {
        let state = host.wgpu_render_state.clone();
        let state = state.ok_or("the interface needs a host that draws with wgpu")?;
        let mut kept = Kept::load(host.storage);
        if setup.host.is_embedded() {
            kept.layout.panels = Panels::NONE;
        }
        let mut app = Self {
            context: host.egui_ctx.clone(),
            library: setup.library,
            host: setup.host,
            inbox: Inbox::new(host.egui_ctx.clone()),
            threaded: setup.threaded,
            link_budget: setup.link_budget,
            studio: Studio::new(state, setup.quality),
            screen: Screen::Empty,
            chooser: Chooser::default(),
            notices: Notices::default(),
            help: false,
            cpu_seconds: None,
            told: None,
            tilts_device: false,
            random_mazes: 0,
            exports: Exports::default(),
            address: Address::default(),
            link: LinkDialog::default(),
            kept,
        };
        make_readable(&app.context);
        if app.host.has_coarse_pointer() {
            suit_fingers(&app.context);
        }
        match setup.start {
            Some(Start::Scene(scene, source)) => app.watch(*scene, source),
            Some(Start::Maze(maze)) => app.play(*maze),
            Some(Start::Link(link)) => app.follow(&link),
            None => app.welcome(),
        }
        Ok(app)
    }

    /// Has a scene play behind the chooser, so that there is something to see whatever is chosen.
    fn welcome(&mut self) {
        let entries = self.library.entries().unwrap_or_default();
        if let Some((scene, source)) =
            entries.into_iter().find_map(|it| Some((it.scene.ok()?, it.source)))
        {
            self.watch(scene, source);
            self.command(Command::Play);
        }
        self.open_chooser();
    }

    /// Opens a scene: a maze to be played, any other to be watched.
    fn open(&mut self, scene: Scene, source: Source) {
        match Maze::from_scene(&scene) {
            Ok(maze) => self.play_linked(maze, Link::to_scene(&scene)),
            Err(_) => self.watch(scene, source),
        }
    }

    /// Watches a scene from now on; says so where it cannot be.
    pub fn watch(&mut self, scene: Scene, source: Source) {
        match Watching::new(scene, source, self.threaded, &self.context) {
            Ok(mut watching) => {
                self.host.watch(&watching.source);
                // A page has no files to come back to.
                if let Source::File(path) = &watching.source
                    && cfg!(not(target_arch = "wasm32"))
                {
                    self.kept.remember(path);
                    if let Ok(written) = WrittenScene::from_file(path, Vec::new()) {
                        watching.set_written(written);
                    }
                }
                watching.set_layout(self.kept.layout);
                self.show(Screen::Watching(Box::new(watching)));
            }
            Err(error) => self.notices.complain(error),
        }
    }

    /// Plays a maze from now on.
    pub fn play(&mut self, maze: Maze) {
        let link = Link::to_scene(maze.scene());
        self.play_linked(maze, link);
    }

    fn play_linked(&mut self, maze: Maze, link: Link) {
        match MazeScreen::new(maze, link) {
            Ok(mut screen) => {
                self.keep_game();
                if let Some(kept) = &self.kept.game {
                    screen.resume(kept);
                }
                self.host.show_link(screen.link());
                self.show(Screen::Maze(Box::new(screen)));
            }
            Err(error) => self.notices.complain(error),
        }
    }

    /// Keeps how far the game has got that is played.
    fn keep_game(&mut self) {
        if let Screen::Maze(screen) = &self.screen {
            self.kept.game = Some(screen.kept());
        }
    }

    /// Fills the window with something else; a film of what was there before is complete.
    fn show(&mut self, screen: Screen) {
        self.keep_game();
        self.notices.clear();
        self.chooser.close();
        self.exports.end_film();
        self.screen = screen;
    }

    /// The scene being watched, if any is.
    pub fn watching(&self) -> Option<&Watching> {
        match &self.screen {
            Screen::Watching(watching) => Some(watching),
            _ => None,
        }
    }

    /// Tells the physics of the scene being watched what to do.
    pub fn command(&mut self, command: Command) {
        if let Screen::Watching(watching) = &mut self.screen {
            watching.commands.push(command);
        }
    }

    /// Where in a picture of this place on the screen the sphere at an index is shown.
    pub fn place_of(&self, index: usize, picture: Rect) -> Option<Pos2> {
        self.watching()?.place_of(index, picture)
    }

    /// The maze being played, if any is.
    pub fn maze(&self) -> Option<&MazeScreen> {
        match &self.screen {
            Screen::Maze(screen) => Some(screen),
            _ => None,
        }
    }

    /// All scenes that can be chosen.
    pub fn library(&self) -> &Library {
        &self.library
    }

    /// Whether a scene is being chosen.
    pub fn is_choosing(&self) -> bool {
        self.chooser.is_open()
    }

    /// Whether a film is being recorded.
    pub fn is_recording(&self) -> bool {
        self.exports.is_recording()
    }

    /// Time of the processor for the last picture of the interface \[s\]; `None` before there was
    /// one.
    pub fn cpu_seconds(&self) -> Option<f32> {
        self.cpu_seconds
    }

    /// What it tells the user.
    pub fn notices(&self) -> &Notices {
        &self.notices
    }

    fn open_chooser(&mut self) {
        if let Err(error) = self.chooser.open(&self.library, &self.kept.recent) {
            self.notices.complain(error);
        }
    }

    /// Does what a key or button means.
    pub fn act(&mut self, action: Action) {
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
                Screen::Maze(screen) => act_in_maze(screen, action),
                Screen::Empty => {}
            },
        }
    }

    /// Ends the way to another time where it has come to, unless the key is for a dialog.
    fn stop_seeking(&mut self) {
        let has_dialog = self.help || self.link.is_open() || self.chooser.is_open();
        if !has_dialog && self.watching().is_some_and(|it| it.view().seeking.is_some()) {
            self.command(Command::StopSeeking);
        }
    }

    /// How the interface works now.
    fn manner(&self) -> Manner {
        let recording = self.exports.is_recording();
        Manner { dark: self.context.theme() == Theme::Dark, recording }
    }

    /// Name and time of what is shown \[s\].
    fn shown(&self) -> Option<(String, f64)> {
        match &self.screen {
            Screen::Watching(watching) => {
                Some((watching.view().scene.name.clone(), watching.view().time))
            }
            Screen::Maze(screen) => {
                Some((screen.game().scene().name.clone(), screen.game().elapsed()))
            }
            Screen::Empty => None,
        }
    }

    /// Says what went wrong in the physics.
    fn complain_of_session(&mut self) {
        let Screen::Watching(watching) = &mut self.screen else { return };
        if let Some(error) = watching.refused.take() {
            self.notices.complain(error);
        }
        let error = watching.view().playback.error.clone();
        // Each gets one notice: it stays in the view until something goes well.
        let is_told = match (&error, &self.told) {
            (Some(error), Some(told)) => Arc::ptr_eq(error, told),
            _ => false,
        };
        if let Some(error) = error.as_ref().filter(|_| !is_told) {
            self.notices.complain(error);
        }
        self.told = error;
    }

    /// Says what went wrong on the graphics device. The scene goes on, and can be saved.
    fn complain_of_studio(&mut self) {
        if let Some(text) = self.studio.failure() {
            let advice = "Save the scene with Ctrl + S, and start anew.";
            self.notices.complain(format!("{text}. {advice}"));
        }
    }

    fn screen(&mut self, ui: &mut Ui) {
        let manner = self.manner();
        let margin = egui::Frame::NONE.fill(ui.visuals().panel_fill);
        let (mut wish, mut wanted) = (None, None);
        match &mut self.screen {
            Screen::Empty => {
                egui::CentralPanel::default().show(ui, |ui| {
                    ui.centered_and_justified(|ui| ui.weak("Press Enter to choose a scene."));
                });
            }
            Screen::Watching(watching) => {
                for action in watching.panels(ui, manner) {
                    watching.act(action);
                }
                wanted = watching.wanted.take();
                self.kept.layout = watching.layout();
                let studio = &mut self.studio;
                let shown = egui::CentralPanel::default()
                    .frame(margin)
                    .show(ui, |ui| watching.picture(ui, studio, manner));
                shown.inner.into_iter().for_each(|action| watching.act(action));
            }
            Screen::Maze(screen) => {
                let studio = &mut self.studio;
                wish = egui::CentralPanel::default()
                    .frame(margin)
                    .show(ui, |ui| screen.picture(ui, studio, manner.dark))
                    .inner;
            }
        }
        if let Some(wanted) = wanted {
            self.save_plots(wanted);
        }
        let Screen::Maze(screen) = &self.screen else { return };
        match wish {
            Some(Wish::Watch) => {
                let scene = screen.game().maze().scene().clone();
                self.watch(scene, Source::Registered);
            }
            Some(Wish::Next) => self.next_maze(),
            None => {}
        }
    }

    fn advance(&mut self, ui: &Ui) {
        match &mut self.screen {
            Screen::Empty => {}
            Screen::Watching(watching) => watching.advance(ui),
            // A game waits behind the dialog.
            Screen::Maze(_) if self.chooser.is_open() => {}
            Screen::Maze(screen) => {
                screen.stick = self.host.stick();
                let steering = screen.steering(ui);
                if let Err(error) = screen.advance(ui, steering) {
                    self.notices.complain(error);
                }
            }
        }
    }
}

fn act_in_maze(screen: &mut MazeScreen, action: Action) {
    match action {
        Action::PlayOrPause => screen.play_or_pause(),
        Action::Restart => screen.play_again(),
        Action::SceneCamera => screen.look_from(Preset::Scene),
        Action::FrontCamera => screen.look_from(Preset::Front),
        Action::TopCamera => screen.look_from(Preset::Top),
        _ => {}
    }
}

impl eframe::App for App {
    fn save(&mut self, storage: &mut dyn eframe::Storage) {
        self.keep_game();
        self.kept.save(storage);
    }

    fn auto_save_interval(&self) -> std::time::Duration {
        // A page has no end at which it could be kept for sure.
        std::time::Duration::from_secs(5)
    }

    fn ui(&mut self, ui: &mut Ui, frame: &mut eframe::Frame) {
        self.cpu_seconds = frame.info().cpu_usage;
        let context = ui.ctx().clone();
        self.studio.begin_frame();
        // A dialog has the keys for itself; on the win screen Enter plays again.
        let is_won = self.maze().is_some_and(MazeScreen::is_won);
        if !self.chooser.is_open() {
            for action in action::pressed(&context, is_won) {
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
        match self.chooser.show(&context, &mut self.studio) {
            Some(Chosen::Scene(scene, source)) => self.open(*scene, source),
            Some(Chosen::File(path)) => self.inbox.put(ReadFile::from_disk(&path)),
            Some(Chosen::AnyFile) => self.host.open_file(&self.inbox),
            None => {}
        }
        let is_maze = self.maze().is_some();
        help::show(&context, &mut self.help, is_maze);
        self.links();
        self.drop_target();
        self.notices.show(ui);
    }
}
