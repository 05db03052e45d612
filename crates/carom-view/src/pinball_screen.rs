//! The pinball game on the screen: controls, picture, score and balls.

use std::collections::BTreeMap;

use carom::DVec3;
use carom_pinball::{Game, GameError, GameEvent, GameState, Keys, Table};
use carom_render::draw_world;
use carom_scene::Palette;
use carom_scene::scene::Scene;
use carom_session::Link;
use egui::{Event, Key, PointerButton, Pos2, Sense, TouchPhase, Ui, Vec2};

use crate::game_view::{GameScreen, GameView, LastScreen, Wish, count_line};
use crate::input_log::{Input, InputLog};
use crate::layout::is_touched;
use crate::saved::SavedGame;
use crate::studio::Studio;

/// Direction from the table to the camera: over the player's shoulder.
const FROM: DVec3 = DVec3::new(0.0, 1.0, 0.55);

/// Keys of the left flipper, of the right flipper, and of the plunger.
const KEYS: [[Key; 2]; 3] =
    [[Key::ArrowLeft, Key::A], [Key::ArrowRight, Key::D], [Key::ArrowDown, Key::S]];

/// A pinball game that is being played.
pub struct PinballScreen {
    game: Game,
    palette: Palette,
    view: GameView,
    /// Where each finger is on the screen, by its number.
    fingers: BTreeMap<u64, Pos2>,
    /// Middle of the last picture: fingers to the left of it raise the left flipper.
    middle: f32,
    /// What was pressed in each frame of this game.
    pressed: InputLog<Keys>,
    /// Text of the keys that reached the best score, if it is known.
    best_keys: Option<String>,
    /// The game of the link that is played again.
    replay: Option<Replay>,
}

/// A recorded game that is played again.
struct Replay {
    /// Keys of the frames that are left.
    keys: Box<dyn Iterator<Item = Keys>>,
    /// The player's own best score.
    best: Option<u64>,
}

impl Input for Keys {
    fn write(self) -> String {
        let letters = [(self.left, 'L'), (self.right, 'R'), (self.plunger, 'P')];
        let pressed: String = letters
            .into_iter()
            .filter_map(|(is_pressed, letter)| is_pressed.then_some(letter))
            .collect();
        if pressed.is_empty() { "-".to_owned() } else { pressed }
    }

    fn read(text: &str) -> Option<Self> {
        let has = |letter| text.contains(letter);
        let keys = Self { left: has('L'), right: has('R'), plunger: has('P') };
        (keys.write() == text).then_some(keys)
    }
}

impl PinballScreen {
    /// Starts a game; `link` leads to its table.
    ///
    /// # Errors
    /// If the table cannot be played.
    pub fn new(table: Table, link: Link) -> Result<Self, GameError> {
        let palette = Palette::new(table.scene())?;
        let game = Game::new(table)?;
        let view = GameView::new(FROM, link);
        let fingers = BTreeMap::new();
        let (pressed, best_keys, replay) = (InputLog::default(), None, None);
        Ok(Self { game, palette, view, fingers, middle: 0.0, pressed, best_keys, replay })
    }

    /// The game.
    pub fn game(&self) -> &Game {
        &self.game
    }

    /// Returns the points to beat, if its link states them.
    pub fn goal(&self) -> Option<f64> {
        self.view.link.goal()
    }

    /// Returns whether the last ball is lost.
    pub fn is_over(&self) -> bool {
        self.game.state() == GameState::Over
    }

    /// Advances the game by the time since the last frame.
    ///
    /// # Errors
    /// If the physics refuses a frame; the game is then unchanged.
    pub fn advance(&mut self, ui: &Ui) -> Result<(), GameError> {
        self.follow_fingers(ui);
        let by_player = self.keys(ui);
        let (wall_seconds, now) = ui.input(|input| (f64::from(input.unstable_dt), input.time));
        for _ in 0..self.view.pace.frames_due(wall_seconds, self.game.frame_time()) {
            self.view.clock += self.game.frame_time();
            let Some(keys) = self.keys_of_frame(by_player, now) else { continue };
            let before = self.ball();
            let stepped = self.game.step(keys).map(<[_]>::to_vec);
            // A step that failed once would fail again.
            let events = stepped.inspect_err(|_| self.view.pace.set_playing(false))?;
            self.pressed.push(keys);
            events.into_iter().for_each(|event| self.note(event, now));
            if let (Some((id, before, radius)), Some((ball, after, _))) = (before, self.ball())
                && id == ball
            {
                self.view.roll.on(after - before, DVec3::Y, radius);
            }
        }
        ui.ctx().request_repaint();
        Ok(())
    }

    /// Returns the keys of the next frame: those of the player, or of the game that is played again. Where the latter ends
    /// before the game is over, the player begins.
    fn keys_of_frame(&mut self, by_player: Keys, now: f64) -> Option<Keys> {
        let is_over = self.is_over();
        let Some(replay) = self.replay.as_mut().filter(|_| !is_over) else {
            return Some(by_player);
        };
        let keys = replay.keys.next();
        if keys.is_none() {
            self.play_again();
            self.view.say("Now you".to_owned(), now);
        }
        keys
    }

    /// Returns number, position \[m\] and radius \[m\] of the ball in play.
    fn ball(&self) -> Option<(u64, DVec3, f64)> {
        let spheres = self.game.world().spheres();
        let id = self.game.ball()?;
        Some((id.number(), spheres.positions()[0], spheres.radii()[0]))
    }

    fn note(&mut self, event: GameEvent, now: f64) {
        let text = match event {
            GameEvent::Lit { points, .. } => format!("Target: {points}"),
            GameEvent::AllLit { points } => format!("All targets: {points}"),
            GameEvent::Lost { left: 1 } => "The last ball".to_owned(),
            GameEvent::Lost { left } => format!("{left} balls left"),
            GameEvent::Over { is_best, .. } => return self.note_end(is_best),
            GameEvent::Kicked { .. } => return,
        };
        self.view.say(text, now);
    }

    /// Keeps the keys of the best game; one that is played again is none of the player's.
    fn note_end(&mut self, is_best: bool) {
        match &self.replay {
            Some(replay) => self.game.set_best(replay.best),
            None if is_best => self.best_keys = self.pressed.to_text(),
            None => {}
        }
    }

    /// Follows each finger from its touch until it is lifted.
    fn follow_fingers(&mut self, ui: &Ui) {
        ui.input(|input| {
            for event in &input.events {
                let Event::Touch { id, phase, pos, .. } = event else { continue };
                match phase {
                    TouchPhase::Start | TouchPhase::Move => self.fingers.insert(id.0, *pos),
                    TouchPhase::End | TouchPhase::Cancel => self.fingers.remove(&id.0),
                };
            }
        });
    }

    /// Returns what the player presses, by keys or by fingers on the halves of the picture. While the ball waits, fingers
    /// pull the plunger, too.
    fn keys(&self, ui: &Ui) -> Keys {
        let is_held = |keys: [Key; 2]| {
            ui.input(|input| {
                !input.modifiers.any() && keys.into_iter().any(|key| input.key_down(key))
            })
        };
        let [left, right, plunger] = KEYS.map(is_held);
        let mut sides = self.fingers.values().map(|place| place.x < self.middle);
        Keys {
            left: left || sides.clone().any(|is_left| is_left),
            right: right || sides.any(|is_left| !is_left),
            plunger: plunger || (self.game.waits() && !self.fingers.is_empty()),
        }
    }

    /// Shows score, balls and what to press in a line above the picture; returns whether the user wants the recorded game.
    fn counts(&self, ui: &mut Ui) -> bool {
        let mut counts =
            vec![format!("Score {}", self.game.score()), format!("Balls {}", self.game.balls())];
        counts.extend(self.game.best().map(|best| format!("Best {best}")));
        counts.extend(self.view.link.goal().map(|goal| format!("To beat {goal}")));
        let hint = match (self.game.waits(), is_touched(ui)) {
            (true, true) => "Hold a finger on the picture, and lift it to shoot.",
            (true, false) => "Hold the down arrow or S, and let go to shoot.",
            (false, true) => "Touch the left or right half to raise a flipper.",
            (false, false) => "Left and right arrow, or A and D, raise the flippers.",
        };
        let can_watch = self.replay.is_none() && self.view.link.moves().is_some();
        count_line(ui, &counts, "Light all targets.", hint, can_watch)
    }
}

impl GameScreen for PinballScreen {
    fn view(&self) -> &GameView {
        &self.view
    }

    fn view_mut(&mut self) -> &mut GameView {
        &mut self.view
    }

    fn title(&self) -> &str {
        self.game.table().title()
    }

    fn scene(&self) -> &Scene {
        self.game.table().scene()
    }

    fn elapsed(&self) -> f64 {
        self.game.elapsed()
    }

    fn last_screen(&self) -> Option<LastScreen> {
        let GameState::Over = self.game.state() else { return None };
        let (score, best) = (self.game.score(), self.game.best().unwrap_or(0));
        if self.replay.is_some() {
            let lines = vec![format!("{score} points"), "This is the game to beat.".to_owned()];
            return Some(LastScreen { heading: "Now you", lines, next: None });
        }
        let comparison = if score >= best {
            "The best score so far.".to_owned()
        } else {
            format!("Best score {best}.")
        };
        let mut lines = vec![format!("{score} points"), comparison];
        lines.extend(self.view.link.goal().map(|goal| match score as f64 > goal {
            true => format!("You beat {goal} points."),
            false => format!("{goal} points are still to beat."),
        }));
        Some(LastScreen { heading: "Game over", lines, next: None })
    }

    fn best(&self) -> Option<f64> {
        self.game.best().map(|best| best as f64)
    }

    fn saved(&self) -> Option<SavedGame> {
        let keys = || self.best_keys.clone();
        self.game.best().map(|best| SavedGame::Pinball { best, keys: keys() })
    }

    fn resume(&mut self, game: &SavedGame) {
        if let SavedGame::Pinball { best, keys } = game {
            self.game.set_best(Some(*best));
            self.best_keys.clone_from(keys);
        }
    }

    fn best_moves(&self) -> Option<&str> {
        self.best_keys.as_deref()
    }

    fn watch(&mut self) -> bool {
        let text = self.view.link.moves();
        let Some(log) = text.and_then(InputLog::<Keys>::from_text) else { return false };
        let best = self.replay.take().map_or(self.game.best(), |replay| replay.best);
        self.play_again();
        self.replay = Some(Replay { keys: Box::new(log.into_frames()), best });
        true
    }

    fn play_again(&mut self) {
        self.game.play_again();
        self.view.start_again();
        self.pressed = InputLog::default();
        self.replay = None;
    }

    fn draw(&mut self) {
        self.palette.set_colliders(&self.game.scene().colliders);
        // Nothing turns a ball without friction; its pattern follows its path along the table.
        let rotation = self.view.roll.rotation;
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
        self.middle = rect.center().x;
        let response = ui.allocate_rect(rect, Sense::click_and_drag());
        response
            .widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, "Pinball table"));
        let turns = self.fingers.is_empty() && response.dragged_by(PointerButton::Primary);
        let drag = if turns { response.drag_delta() } else { Vec2::ZERO };
        self.draw();
        self.view.show(ui, &response, drag, studio);
        self.show_last_screen(ui)
    }
}
