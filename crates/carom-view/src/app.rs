//! The interface as a whole.

#[cfg(not(target_arch = "wasm32"))]
use std::path::Path;
use std::path::PathBuf;
use std::sync::Arc;

use carom_maze::{BUILT_IN_DRAWINGS, Maze, MazeError};
use carom_render::{Picture, Quality, stamp};
use carom_scene::scene::Scene;
use carom_scene::{Library, Source};
use eframe::CreationContext;
use egui::{Context, Pos2, Rect, Theme, Ui};

use crate::action::{self, Action};
use crate::chooser::Chooser;
use crate::maze_screen::{MazeScreen, Wish};
use crate::notices::Notices;
use crate::orbit::Preset;
use crate::studio::Studio;
use crate::watching::{Manner, Watching};
use crate::{help, picture_files};
use carom_session::{Command, SessionError};

/// What the interface starts with.
#[derive(Debug, Clone)]
pub struct Setup {
    /// All scenes that can be chosen.
    pub library: Library,
    /// What is open at the start; the chooser without it.
    pub start: Option<Start>,
    /// Where pictures and films go.
    pub folder: PathBuf,
    /// How much work goes into the pictures on the screen.
    pub quality: Quality,
    /// Whether the physics has a thread of its own.
    pub threaded: bool,
}

/// What is open at the start.
#[derive(Debug, Clone)]
pub enum Start {
    /// A scene to watch.
    Scene(Box<Scene>, Source),
    /// A maze to play.
    Maze(Box<Maze>),
}

/// The interface: hosted by a window, a page or a test.
pub struct App {
    context: Context,
    library: Library,
    folder: PathBuf,
    threaded: bool,
    studio: Studio,
    screen: Screen,
    chooser: Chooser,
    notices: Notices,
    help: bool,
    /// What went wrong in the physics and was told.
    told: Option<Arc<SessionError>>,
    /// Seed of the last random maze.
    random_mazes: u64,
    #[cfg(feature = "film")]
    recorder: Option<crate::recorder::Recorder>,
    #[cfg(not(target_arch = "wasm32"))]
    watched_file: crate::watched_file::WatchedFile,
    #[cfg(feature = "gamepad")]
    gamepad: crate::gamepad::Gamepad,
}

/// What fills the window.
enum Screen {
    Empty,
    Watching(Box<Watching>),
    Maze(Box<MazeScreen>),
}

/// Smallest picture that is saved \[pixels\].
const SMALLEST_PICTURE: [u32; 2] = [1280, 720];

impl App {
    /// The interface, on the graphics device of its host.
    ///
    /// # Errors
    /// A message for people if the host draws without wgpu.
    pub fn new(host: &CreationContext, setup: Setup) -> Result<Self, String> {
        let state = host.wgpu_render_state.clone();
        let state = state.ok_or("the interface needs a host that draws with wgpu")?;
        let mut app = Self {
            context: host.egui_ctx.clone(),
            library: setup.library,
            folder: setup.folder,
            threaded: setup.threaded,
            studio: Studio::new(state, setup.quality),
            screen: Screen::Empty,
            chooser: Chooser::default(),
            notices: Notices::default(),
            help: false,
            told: None,
            random_mazes: 0,
            #[cfg(feature = "film")]
            recorder: None,
            #[cfg(not(target_arch = "wasm32"))]
            watched_file: Default::default(),
            #[cfg(feature = "gamepad")]
            gamepad: Default::default(),
        };
        match setup.start {
            Some(Start::Scene(scene, source)) => app.watch(*scene, source),
            Some(Start::Maze(maze)) => app.play(*maze),
            None => app.open_chooser(),
        }
        Ok(app)
    }

    /// Opens a scene: a maze to be played, any other to be watched.
    fn open(&mut self, scene: Scene, source: Source) {
        match Maze::from_scene(&scene) {
            Ok(maze) => self.play(maze),
            Err(_) => self.watch(scene, source),
        }
    }

    /// Watches a scene from now on; says so where it cannot be.
    pub fn watch(&mut self, scene: Scene, source: Source) {
        match Watching::new(scene, source, self.threaded, &self.context) {
            Ok(watching) => {
                #[cfg(not(target_arch = "wasm32"))]
                self.watched_file.watch(&watching.source);
                self.show(Screen::Watching(Box::new(watching)));
            }
            Err(error) => self.notices.complain(error),
        }
    }

    /// Plays a maze from now on.
    pub fn play(&mut self, maze: Maze) {
        match MazeScreen::new(maze) {
            Ok(screen) => {
                self.show(Screen::Maze(Box::new(screen)));
            }
            Err(error) => self.notices.complain(error),
        }
    }

    /// Fills the window with something else; a film of what was there before is complete.
    fn show(&mut self, screen: Screen) {
        self.notices.clear();
        self.chooser.close();
        #[cfg(feature = "film")]
        self.finish_film();
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

    /// What it tells the user.
    pub fn notices(&self) -> &Notices {
        &self.notices
    }

    fn open_chooser(&mut self) {
        if let Err(error) = self.chooser.open(&self.library) {
            self.notices.complain(error);
        }
    }

    /// Opens a file that was dropped on the window: a scene, or a maze drawn with characters.
    #[cfg(not(target_arch = "wasm32"))]
    fn open_dropped(&mut self) {
        let files = self.context.input(|input| input.raw.dropped_files.clone());
        for file in files {
            let path = file.path().to_owned();
            let text = file.bytes().map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
            match text {
                Ok(text) => self.open_text(&text, &path),
                Err(error) => {
                    self.notices.complain(format!("cannot read {}: {error}", path.display()));
                }
            }
        }
    }

    /// Opens the text of a file.
    #[cfg(not(target_arch = "wasm32"))]
    fn open_text(&mut self, text: &str, path: &Path) {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if path.extension().is_some_and(|ending| ending == "txt") {
            let name = name.trim_end_matches(".txt");
            match Maze::from_text(text, name) {
                Ok(maze) => self.play(maze),
                Err(error) => self.notices.complain(format!("{}: {error}", path.display())),
            }
            return;
        }
        match Scene::from_toml(text, &name) {
            Ok(scene) => {
                self.open(scene, Source::File(path.to_owned()));
            }
            Err(error) => self.notices.complain(error),
        }
    }

    /// Reads a scene file anew that was changed on the disk.
    #[cfg(not(target_arch = "wasm32"))]
    fn reload_changed(&mut self) {
        let now = self.context.input(|input| input.time);
        let Screen::Watching(watching) = &mut self.screen else { return };
        if self.watched_file.is_any() {
            self.context.request_repaint_after_secs(crate::watched_file::INTERVAL as f32);
        }
        let Some(path) = self.watched_file.changed(now) else { return };
        let reloaded = Scene::from_file(&path, &[]).and_then(|scene| watching.reload(scene));
        match reloaded {
            Ok(()) => {
                self.notices.clear();
                self.notices.tell(format!("{} was changed, and read anew", path.display()));
            }
            Err(error) => self.notices.complain(error),
        }
    }

    /// Does what was asked for by a key or button.
    pub fn act(&mut self, action: Action) {
        match action {
            Action::Choose => self.open_chooser(),
            Action::Help => self.help ^= true,
            Action::Theme => {
                let dark = self.context.theme() == Theme::Dark;
                self.context.set_theme(if dark { Theme::Light } else { Theme::Dark });
            }
            Action::Close => {
                self.help = false;
                self.chooser.close();
            }
            Action::Screenshot => self.screenshot(),
            Action::Record => self.record(),
            Action::Save => self.save(),
            _ => match &mut self.screen {
                Screen::Watching(watching) => watching.act(action),
                Screen::Maze(screen) => act_in_maze(screen, action),
                Screen::Empty => {}
            },
        }
    }

    /// How the interface works now.
    fn manner(&self) -> Manner {
        #[cfg(feature = "film")]
        let recording = self.recorder.is_some();
        #[cfg(not(feature = "film"))]
        let recording = false;
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

    fn snapshot(&mut self, size: [u32; 2]) -> Option<Picture> {
        let manner = self.manner();
        let drawn = match &mut self.screen {
            Screen::Watching(watching) => watching.snapshot(&mut self.studio, manner, size),
            Screen::Maze(screen) => screen.snapshot(&mut self.studio, size),
            Screen::Empty => return None,
        };
        drawn.map_err(|error| self.notices.complain(error)).ok()
    }

    /// Saves a picture with the simulation time on it, of the size of the window at least.
    fn screenshot(&mut self) {
        let Some((name, time)) = self.shown() else { return };
        let window = self.context.content_rect().size() * self.context.pixels_per_point();
        let [width, height] = SMALLEST_PICTURE;
        let size = [width.max(window.x as u32), height.max(window.y as u32)];
        let Some(mut picture) = self.snapshot(size) else { return };
        stamp(&mut picture, &picture_files::stamp_text(&name, time));
        #[cfg(not(target_arch = "wasm32"))]
        {
            let path = picture_files::new_name(&self.folder, &name, time, "png");
            match picture.save_png(&path) {
                Ok(()) => self.notices.tell(format!("saved {}", path.display())),
                Err(error) => self.notices.complain(error),
            }
        }
    }

    /// Saves the present state as a scene file.
    fn save(&mut self) {
        let Screen::Watching(watching) = &self.screen else {
            self.notices.complain("a game cannot be saved as a scene");
            return;
        };
        let view = watching.view();
        let path = picture_files::new_name(&self.folder, &view.scene.name, view.time, "toml");
        let text = view.scene_now().to_toml();
        let saved =
            std::fs::create_dir_all(&self.folder).and_then(|()| std::fs::write(&path, text));
        match saved {
            Ok(()) => self.notices.tell(format!("saved {}", path.display())),
            Err(error) => {
                self.notices.complain(format!("cannot write {}: {error}", path.display()));
            }
        }
    }

    #[cfg(not(feature = "film"))]
    fn record(&mut self) {
        self.notices.complain("this build of Carom makes no films");
    }

    #[cfg(feature = "film")]
    fn record(&mut self) {
        use crate::recorder::Recorder;
        if self.recorder.is_some() {
            self.finish_film();
            return;
        }
        let Some((name, _)) = self.shown() else { return };
        let time = self.film_clock();
        let path = picture_files::new_name(&self.folder, &name, time, "mp4");
        match Recorder::begin(path, SMALLEST_PICTURE, time) {
            Ok(recorder) => self.recorder = Some(recorder),
            Err(error) => self.notices.complain(error),
        }
        self.context.request_repaint();
    }

    /// Completes the film that is being recorded, if one is.
    #[cfg(feature = "film")]
    fn finish_film(&mut self) {
        match self.recorder.take().map(crate::recorder::Recorder::finish) {
            Some(Ok(text)) => self.notices.tell(text),
            Some(Err(error)) => self.notices.complain(error),
            None => {}
        }
    }

    /// The time by which films go on \[s\].
    #[cfg(feature = "film")]
    fn film_clock(&self) -> f64 {
        match &self.screen {
            Screen::Watching(watching) => watching.view().time,
            Screen::Maze(screen) => screen.clock(),
            Screen::Empty => 0.0,
        }
    }

    /// Adds the frames of the film that are due at the time shown.
    #[cfg(feature = "film")]
    fn film(&mut self) {
        let Some(mut recorder) = self.recorder.take() else { return };
        let time = self.film_clock();
        let added = recorder.add_due(time, |size| self.snapshot(size));
        match added {
            Ok(()) => self.recorder = Some(recorder),
            Err(error) => {
                // What was recorded until then is kept.
                self.recorder = Some(recorder);
                self.finish_film();
                self.notices.complain(error);
            }
        }
    }

    /// Says what went wrong in the physics.
    fn complain_of_session(&mut self) {
        let Screen::Watching(watching) = &mut self.screen else { return };
        if let Some(error) = watching.refused.take() {
            self.notices.complain(error);
        }
        let error = watching.view().playback.error.clone();
        // Each is told once: it stays in the view until something goes well.
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

    /// What there is to choose in the maze game. Returns another maze to play.
    fn mazes(&mut self, ui: &mut Ui) -> Option<Result<Maze, MazeError>> {
        let Screen::Maze(screen) = &mut self.screen else { return None };
        let mut levels_back = screen.levels_back();
        if ui.checkbox(&mut levels_back, "Level back").changed()
            && let Err(error) = screen.set_levels_back(levels_back)
        {
            self.notices.complain(error);
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
            self.random_mazes += 1;
            chosen = Some(Maze::random(self.random_mazes, 8, 6));
        }
        ui.separator();
        chosen
    }

    fn bar(&mut self, ui: &mut Ui) -> Vec<Action> {
        let mut actions = Vec::new();
        ui.horizontal_wrapped(|ui| {
            if ui.button("Scenes").on_hover_text("Enter").clicked() {
                actions.push(Action::Choose);
            }
            if let Some((name, _)) = self.shown() {
                ui.strong(name);
                ui.separator();
            }
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
                ("Light/dark", Action::Theme),
                ("Keys", Action::Help),
            ] {
                if ui.button(text).clicked() {
                    actions.push(action);
                }
            }
        });
        actions
    }

    fn screen(&mut self, ui: &mut Ui) {
        let manner = self.manner();
        let margin = egui::Frame::NONE;
        let mut wish = None;
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
                let studio = &mut self.studio;
                egui::CentralPanel::default()
                    .frame(margin)
                    .show(ui, |ui| watching.picture(ui, studio, manner));
            }
            Screen::Maze(screen) => {
                let studio = &mut self.studio;
                wish = egui::CentralPanel::default()
                    .frame(margin)
                    .show(ui, |ui| screen.picture(ui, studio, manner.dark))
                    .inner;
            }
        }
        if wish == Some(Wish::Watch)
            && let Screen::Maze(screen) = &self.screen
        {
            let scene = screen.game().maze().scene().clone();
            self.watch(scene, Source::Registered);
        }
    }

    fn advance(&mut self, ui: &Ui) {
        match &mut self.screen {
            Screen::Empty => {}
            Screen::Watching(watching) => watching.advance(ui),
            // A game waits behind the dialog.
            Screen::Maze(_) if self.chooser.is_open() => {}
            Screen::Maze(screen) => {
                #[cfg(feature = "gamepad")]
                {
                    screen.stick = self.gamepad.stick();
                }
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
    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        let context = ui.ctx().clone();
        self.studio.begin_frame();
        // A dialog has the keys for itself; on the win screen Enter plays again.
        let is_won = self.maze().is_some_and(MazeScreen::is_won);
        if !self.chooser.is_open() {
            for action in action::pressed(&context, is_won) {
                self.act(action);
            }
        }
        #[cfg(not(target_arch = "wasm32"))]
        {
            self.open_dropped();
            self.reload_changed();
        }
        self.advance(ui);
        #[cfg(feature = "film")]
        self.film();
        self.complain_of_session();
        self.complain_of_studio();
        let asked = egui::Panel::top("bar").show(ui, |ui| self.bar(ui)).inner;
        self.screen(ui);
        for action in asked {
            self.act(action);
        }
        if let Some((scene, source)) = self.chooser.show(&context, &mut self.studio) {
            self.open(scene, source);
        }
        help::show(&context, &mut self.help);
        self.notices.show(ui);
    }
}
