//! The maze game on the screen: controls, picture, counts and times.

use carom::{DVec3, QueryFilter};
use carom_maze::{Game, GameError, GameEvent, GameState, Maze, Options, Steering, Tilt};
use carom_render::draw_world;
use carom_scene::Palette;
use carom_scene::scene::Scene;
use carom_session::Link;
use egui::{Align2, Area, Frame, Id, Key, Rect, Response, RichText, Sense, Ui, Vec2};

use crate::game_view::{GameScreen, GameView, LastScreen, Wish, count_line};
use crate::input_log::InputLog;
use crate::layout::is_touched;
use crate::maze_input::MazeInput;
use crate::ring;
use crate::saved::SavedGame;
use crate::studio::Studio;

/// Friction of a rolling ball: enough to roll at the steepest tilt, but too little to hold it at
/// walls.
const FRICTION: f64 = 0.15;

/// Direction from the maze to the camera: steep, so that walls hide little of the floor.
const FROM: DVec3 = DVec3::new(0.0, 1.0, 0.45);

/// The player's task, with and without collectibles.
const GOALS: [&str; 2] =
    ["Touch the red wall; collect all for a best time.", "Touch the red wall."];

/// A game that is being played.
pub struct MazeScreen {
    game: Game,
    palette: Palette,
    view: GameView,
    /// Tilt by a gamepad or a tilted device, each part in \[-1, 1\].
    pub stick: Option<Vec2>,
    /// Distance that a finger has been dragged in the picture, in points.
    finger: Option<Vec2>,
    /// Whether a continued game waits for the player.
    waits: bool,
    /// What the player did in each frame of this game; `None` if its beginning is not known.
    pressed: Option<InputLog<MazeInput>>,
    /// Text of the moves that reached the best time, if they are known.
    best_moves: Option<String>,
    /// The game of the link that is played again.
    replay: Option<Replay>,
}

/// A recorded game that is played again.
struct Replay {
    /// Inputs of the frames that are left.
    inputs: Box<dyn Iterator<Item = MazeInput>>,
    /// The player's own best time \[s\].
    best: Option<f64>,
    /// The player's own options.
    options: Options,
}

/// Keys, and the parts of the full tilt towards +x and +z that they give.
const KEYS: [(Key, f64, f64); 8] = [
    (Key::ArrowRight, 1.0, 0.0),
    (Key::ArrowLeft, -1.0, 0.0),
    (Key::ArrowDown, 0.0, 1.0),
    (Key::ArrowUp, 0.0, -1.0),
    (Key::D, 1.0, 0.0),
    (Key::A, -1.0, 0.0),
    (Key::S, 0.0, 1.0),
    (Key::W, 0.0, -1.0),
];

impl MazeScreen {
    /// Starts a game; `link` leads to its maze.
    ///
    /// # Errors
    /// If the maze cannot be played.
    pub fn new(maze: Maze, link: Link) -> Result<Self, GameError> {
        let game = Game::new(maze, Options::default())?;
        let palette = Palette::new(game.scene())?;
        let view = GameView::new(FROM, link);
        let pressed = Some(InputLog::default());
        let (stick, finger, best_moves, replay) = (None, None, None, None);
        Ok(Self { game, palette, view, stick, finger, waits: false, pressed, best_moves, replay })
    }

    /// Returns whether the win screen is shown.
    pub fn is_won(&self) -> bool {
        matches!(self.game.state(), GameState::Won { .. })
    }

    /// The game.
    pub fn game(&self) -> &Game {
        &self.game
    }

    /// Advances the game by the time since the last frame.
    ///
    /// # Errors
    /// If the physics refuses a frame; the game is then unchanged.
    pub fn advance(&mut self, ui: &Ui, steering: Steering) -> Result<(), GameError> {
        let wall_seconds = ui.input(|input| f64::from(input.unstable_dt));
        let now = ui.input(|input| input.time);
        if self.waits && (steering != Steering::NONE || self.view.pace.is_playing()) {
            self.go_on();
        }
        for _ in 0..self.view.pace.frames_due(wall_seconds, self.game.frame_time()) {
            self.view.clock += self.game.frame_time();
            let Some(input) = self.input_of_frame(steering, now)? else { continue };
            let before = self.game.ball_in_maze().0;
            let stepped = self.game.step(input.steering(self.full_tilt())).map(<[_]>::to_vec);
            // A step that failed once would fail again.
            let events = stepped.inspect_err(|_| self.view.pace.set_playing(false))?;
            if let Some(pressed) = &mut self.pressed {
                pressed.push(input);
            }
            for event in events {
                self.note(event, now);
            }
            let way = self.game.ball_in_maze().0 - before;
            // A jump back to the start is no rolling.
            let radius = self.game.maze().ball_radius();
            if way.length() < radius {
                self.view.roll.on(way, DVec3::Y, radius);
            }
        }
        ui.ctx().request_repaint();
        Ok(())
    }

    /// Returns the input of the next frame: that of the player, or of the game that is played again. Where the latter
    /// ends before the end wall, the player begins.
    fn input_of_frame(
        &mut self,
        steering: Steering,
        now: f64,
    ) -> Result<Option<MazeInput>, GameError> {
        let is_won = self.is_won();
        let Some(replay) = self.replay.as_mut().filter(|_| !is_won) else {
            let options = [self.rolls(), self.levels_back()];
            return Ok(Some(MazeInput::of(steering, self.full_tilt(), options)));
        };
        let input = replay.inputs.next();
        match input {
            Some(input) if input.rolls != self.rolls() => self.set_rolls(input.rolls)?,
            Some(_) => {}
            None => {
                self.play_again();
                self.view.say("Now you".to_owned(), now);
            }
        }
        if let Some(input) = input.filter(|it| it.levels_back != self.levels_back()) {
            self.set_levels_back(input.levels_back)?;
        }
        Ok(input)
    }

    /// Returns the angle of a full tilt \[rad\].
    fn full_tilt(&self) -> f64 {
        self.game.options().max_tilt_degrees.to_radians()
    }

    /// Keeps the moves of the best game; one that is played again is none of the player's.
    fn note_end(&mut self, is_best: bool) {
        match &self.replay {
            Some(replay) => self.game.set_best(replay.best),
            None if is_best => {
                self.best_moves = self.pressed.as_ref().and_then(InputLog::to_text);
            }
            None => {}
        }
    }

    /// Ends a recorded game; the player's own options hold again.
    fn end_replay(&mut self) {
        if let Some(Replay { options, best, .. }) = self.replay.take() {
            self.game.set_best(best);
            // They held before.
            self.game.set_options(options).ok();
        }
    }

    fn note(&mut self, event: GameEvent, now: f64) {
        let of = self.game.maze().collectibles().count();
        let text = match event {
            GameEvent::Collected { count, .. } => format!("{count} of {of}"),
            GameEvent::Fell => "Off the edge - once more from the start".to_owned(),
            GameEvent::Won { is_best, .. } => return self.note_end(is_best),
        };
        self.view.say(text, now);
    }

    /// Returns the tilt by keys, mouse, finger or gamepad.
    pub fn steering(&self, ui: &Ui) -> Steering {
        let most = self.full_tilt();
        let towards =
            |x: f64, z: f64| Steering::Towards(Tilt { about_x: z * most, about_z: -x * most });
        if let Some(stick) = self.stick.filter(|stick| stick.length() > 0.12) {
            return towards(f64::from(stick.x), f64::from(stick.y));
        }
        let by_mouse = ui.input(|input| {
            let press = input.pointer.press_origin().filter(|_| input.pointer.secondary_down());
            press.zip(input.pointer.latest_pos())
        });
        if let Some(way) = self.finger.or(by_mouse.map(|(from, to)| to - from)) {
            // A drag over a fifth of the picture is a full tilt.
            let full = 0.2 * ui.available_height().max(100.0);
            let way = (way / full).clamp(Vec2::splat(-1.0), Vec2::splat(1.0));
            return towards(f64::from(way.x), f64::from(way.y));
        }
        let held = ui.input(|input| {
            KEYS.iter()
                .filter(|(key, ..)| input.key_down(*key) && !input.modifiers.any())
                .fold([0.0, 0.0], |sum, key| [sum[0] + key.1, sum[1] + key.2])
        });
        Steering::roll(held[0].clamp(-1.0, 1.0), held[1].clamp(-1.0, 1.0))
    }

    /// Returns whether the ball rolls by friction.
    pub fn rolls(&self) -> bool {
        self.game.options().friction > 0.0
    }

    /// Chooses whether the ball rolls by friction or slides without any.
    ///
    /// # Errors
    /// Only errors that the world had from the start.
    pub fn set_rolls(&mut self, rolls: bool) -> Result<(), GameError> {
        let friction = if rolls { FRICTION } else { 0.0 };
        self.game.set_options(Options { friction, ..*self.game.options() })
    }

    /// Returns whether the maze turns back to level when nothing steers it.
    pub fn levels_back(&self) -> bool {
        self.game.options().levels_back
    }

    /// Chooses whether the maze turns back to level when nothing steers it.
    ///
    /// # Errors
    /// Only errors that the options had from the start.
    pub fn set_levels_back(&mut self, levels_back: bool) -> Result<(), GameError> {
        self.game.set_options(Options { levels_back, ..*self.game.options() })
    }

    /// Handles mouse and fingers in the picture. Returns the drag that turns the camera, in points.
    fn hand(&mut self, ui: &Ui, response: &Response) -> Vec2 {
        let (is_touched, fingers) = ui.input(|input| (input.any_touches(), input.multi_touch()));
        self.finger = None;
        if let Some(fingers) = fingers {
            fingers.translation_delta
        } else if is_touched {
            self.finger = response.total_drag_delta();
            Vec2::ZERO
        } else if response.dragged_by(egui::PointerButton::Primary) {
            response.drag_delta()
        } else {
            Vec2::ZERO
        }
    }

    /// Shows collectibles, times and the task in a line above the picture; returns whether the user wants the recorded
    /// game.
    fn counts(&self, ui: &mut Ui) -> bool {
        let of = self.game.maze().collectibles().count();
        let collected = (of > 0).then(|| format!("Collected {} of {of}", self.game.collected()));
        let mut counts: Vec<String> = collected.into_iter().collect();
        counts.push(format!("Time {:.1} s", self.game.elapsed()));
        counts.extend(self.game.best().map(|best| format!("Best {best:.1} s")));
        counts.extend(self.view.link.goal().map(|goal| format!("To beat {goal:.1} s")));
        let hint = if is_touched(ui) {
            "Drag with a finger to tilt the maze."
        } else {
            "Arrow keys or WASD tilt the maze; so does the right mouse button."
        };
        let can_watch = self.replay.is_none() && self.view.link.moves().is_some();
        count_line(ui, &counts, GOALS[usize::from(of == 0)], hint, can_watch)
    }

    /// Draws a ring around the ball where walls hide most of it.
    fn outline(&self, ui: &Ui, rect: Rect) {
        let projection = self.view.projection(rect);
        let spheres = self.game.world().spheres();
        let (center, radius) = (spheres.positions()[0], spheres.radii()[0]);
        let camera = projection.camera;
        // The middle, and four points between it and the edge.
        let across = [DVec3::X, DVec3::Y].map(|axis| 0.7 * radius * (camera.rotation * axis));
        let points = [DVec3::ZERO, across[0], -across[0], across[1], -across[1]];
        let hidden = points.iter().filter(|it| self.is_hidden(center + **it, camera.position));
        if hidden.count() < 3 {
            return;
        }
        let seen = projection.place(center).zip(projection.radius(center, radius));
        if let Some((place, radius)) = seen {
            ring::draw(&ui.painter_at(rect), place, radius);
        }
    }

    /// Returns whether a surface is between a point and the eye, which is above the ceiling.
    fn is_hidden(&self, point: DVec3, eye: DVec3) -> bool {
        let filter = QueryFilter::DEFAULT.with_spheres(false);
        matches!(self.game.world().cast_ray(eye, point - eye, &filter), Ok(Some(_)))
    }

    /// Asks whether to continue an earlier game.
    fn wait(&mut self, ui: &Ui) {
        if !self.waits {
            return;
        }
        let card = |ui: &mut Ui| {
            ui.label(RichText::new("Here you were").size(24.0).strong());
            ui.add_space(8.0);
            if ui.button(RichText::new("Go on").size(18.0)).clicked() {
                self.go_on();
            }
            if ui.button("Start again").clicked() {
                self.play_again();
            }
        };
        // At the lower edge, below the maze.
        let place = [0.0, -24.0];
        let area = Area::new(Id::unique("here you were")).anchor(Align2::CENTER_BOTTOM, place);
        area.show(ui.ctx(), |ui| {
            let frame = Frame::window(ui.style()).inner_margin(20.0);
            frame.show(ui, |ui| ui.vertical_centered(card));
        });
    }

    fn go_on(&mut self) {
        self.view.pace.set_playing(true);
        self.waits = false;
    }
}

impl GameScreen for MazeScreen {
    fn view(&self) -> &GameView {
        &self.view
    }

    fn view_mut(&mut self) -> &mut GameView {
        &mut self.view
    }

    fn title(&self) -> &str {
        self.game.maze().title()
    }

    fn scene(&self) -> &Scene {
        self.game.maze().scene()
    }

    fn elapsed(&self) -> f64 {
        self.game.elapsed()
    }

    fn last_screen(&self) -> Option<LastScreen> {
        let GameState::Won { time } = self.game.state() else { return None };
        if self.replay.is_some() {
            let lines = vec![format!("{time:.1} s"), "This is the game to beat.".to_owned()];
            return Some(LastScreen { heading: "Now you", lines, next: None });
        }
        let has_all = self.game.remaining().next().is_none();
        let is_best = has_all && self.game.best().is_some_and(|best| time <= best);
        let of = self.game.maze().collectibles().count();
        let collected = self.game.collected();
        let with = match of {
            0 => String::new(),
            _ => format!(", {collected} of {of} collected"),
        };
        let comparison = match self.game.best() {
            _ if is_best => "The best time so far.".to_owned(),
            Some(best) => format!("Best time {best:.1} s."),
            None => format!("Collect all {of} for a best time."),
        };
        let mut lines = vec![format!("{time:.1} s{with}"), comparison];
        lines.extend(self.view.link.goal().map(|goal| match has_all && time < goal {
            true => format!("You beat {goal:.1} s."),
            false => format!("{goal:.1} s are still to beat."),
        }));
        Some(LastScreen { heading: "You win!", lines, next: Some("Next maze") })
    }

    fn best(&self) -> Option<f64> {
        self.game.best()
    }

    fn saved(&self) -> Option<SavedGame> {
        let mut game = self.game.clone();
        if let Some(Replay { best, options, .. }) = &self.replay {
            game.set_best(*best);
            game.play_again();
            game.set_options(*options).ok()?;
        }
        let (progress, rolls) = (game.progress(), game.options().friction > 0.0);
        Some(SavedGame::Maze { progress, rolls, moves: self.best_moves.clone() })
    }

    fn resume(&mut self, game: &SavedGame) {
        let SavedGame::Maze { progress, rolls, moves } = game else { return };
        if self.set_rolls(*rolls).is_err() || self.game.resume(progress).is_err() {
            return;
        }
        self.best_moves.clone_from(moves);
        let is_begun = self.game.elapsed() > 0.0;
        self.pressed = (!is_begun).then(InputLog::default);
        self.view.pace.set_playing(!is_begun);
        self.waits = is_begun;
    }

    fn best_moves(&self) -> Option<&str> {
        self.best_moves.as_deref()
    }

    fn watch(&mut self) -> bool {
        let text = self.view.link.moves();
        let Some(log) = text.and_then(InputLog::<MazeInput>::from_text) else { return false };
        self.play_again();
        let (best, options) = (self.game.best(), *self.game.options());
        self.replay = Some(Replay { inputs: Box::new(log.into_frames()), best, options });
        true
    }

    fn play_again(&mut self) {
        self.end_replay();
        self.game.play_again();
        self.view.start_again();
        self.pressed = Some(InputLog::default());
        if self.waits {
            self.go_on();
        }
    }

    fn draw(&mut self) {
        // Without friction nothing turns the ball; its pattern then follows its path along the
        // maze, however the maze is tilted.
        let rotation = if self.rolls() {
            self.game.world().spheres().get(0).orientation
        } else {
            self.game.tilt() * self.view.roll.rotation
        };
        let Self { game, palette, view, .. } = self;
        draw_world(game.scene(), game.world(), palette, |_| Some(rotation), &mut view.drawing);
        view.adapt();
    }

    fn picture(&mut self, ui: &mut Ui, studio: &mut Studio, dark: bool) -> Option<Wish> {
        self.view.dark = dark;
        if self.counts(ui) {
            self.show_moves(ui);
        }
        let rect = ui.available_rect_before_wrap();
        let response = ui.allocate_rect(rect, Sense::click_and_drag());
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, "Maze"));
        let drag = self.hand(ui, &response);
        self.draw();
        self.view.show(ui, &response, drag, studio);
        self.outline(ui, rect);
        self.wait(ui);
        self.show_last_screen(ui)
    }
}
