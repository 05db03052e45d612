//! The pinball game on the screen: controls, picture, score and balls.

use std::collections::BTreeMap;

use carom::DVec3;
use carom_pinball::{Game, GameError, GameEvent, GameState, Keys, Table};
use carom_render::{GpuError, Roll, draw_world};
use carom_scene::Palette;
use carom_session::{Link, Pace};
use egui::{
    Align2, Area, Event, Frame, Id, Key, PointerButton, Pos2, RichText, Sense, TouchPhase, Ui, Vec2,
};

use crate::game_view::{GameView, Wish, count_line};
use crate::layout::is_touched;
use crate::orbit::Preset;
use crate::snapshot::Snapshot;
use crate::studio::Studio;

/// Direction from the table to the camera: over the player's shoulder.
const FROM: DVec3 = DVec3::new(0.0, 1.0, 0.55);

/// Keys of the left flipper, of the right flipper, and of the plunger.
const KEYS: [[Key; 2]; 3] =
    [[Key::ArrowLeft, Key::A], [Key::ArrowRight, Key::D], [Key::ArrowDown, Key::S]];

/// A pinball game that is being played.
pub struct PinballScreen {
    game: Game,
    link: Link,
    pace: Pace,
    palette: Palette,
    roll: Roll,
    view: GameView,
    dark: bool,
    /// Where each finger is on the screen, by its number.
    fingers: BTreeMap<u64, Pos2>,
    /// Middle of the last picture: fingers to the left of it raise the left flipper.
    middle: f32,
    /// Time played, including the last screen \[s\].
    clock: f64,
}

impl PinballScreen {
    /// Starts a game; `link` leads to its table.
    ///
    /// # Errors
    /// If the table cannot be played.
    pub fn new(table: Table, link: Link) -> Result<Self, GameError> {
        let palette = Palette::new(table.scene())?;
        let game = Game::new(table)?;
        let mut pace = Pace::new();
        pace.set_playing(true);
        Ok(Self {
            game,
            link,
            pace,
            palette,
            roll: Roll::START,
            view: GameView::new(FROM),
            dark: false,
            fingers: BTreeMap::new(),
            middle: 0.0,
            clock: 0.0,
        })
    }

    /// The game.
    pub fn game(&self) -> &Game {
        &self.game
    }

    /// A link to the table.
    pub fn link(&self) -> &Link {
        &self.link
    }

    /// Returns whether the last ball is lost.
    pub fn is_over(&self) -> bool {
        self.game.state() == GameState::Over
    }

    /// Returns the time played, including the last screen \[s\]; films follow it.
    pub fn clock(&self) -> f64 {
        self.clock
    }

    /// Pauses or resumes the game.
    pub fn play_or_pause(&mut self) {
        self.pace.set_playing(!self.pace.is_playing());
    }

    /// Restarts the game and keeps the best score.
    pub fn play_again(&mut self) {
        self.game.play_again();
        self.roll = Roll::START;
        self.view.say_nothing();
    }

    /// Moves the camera to a preset.
    pub fn look_from(&mut self, preset: Preset) {
        self.view.look_from(preset);
    }

    /// Advances the game by the time since the last frame.
    ///
    /// # Errors
    /// If the physics refuses a frame; the game is then unchanged.
    pub fn advance(&mut self, ui: &Ui) -> Result<(), GameError> {
        self.follow_fingers(ui);
        let keys = self.keys(ui);
        let (wall_seconds, now) = ui.input(|input| (f64::from(input.unstable_dt), input.time));
        for _ in 0..self.pace.frames_due(wall_seconds, self.game.frame_time()) {
            self.clock += self.game.frame_time();
            let before = self.ball();
            let stepped = self.game.step(keys).map(<[_]>::to_vec);
            // A step that failed once would fail again.
            let events = stepped.inspect_err(|_| self.pace.set_playing(false))?;
            events.into_iter().for_each(|event| self.note(event, now));
            if let (Some((id, before, radius)), Some((ball, after, _))) = (before, self.ball())
                && id == ball
            {
                self.roll.on(after - before, DVec3::Y, radius);
            }
        }
        ui.ctx().request_repaint();
        Ok(())
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
            GameEvent::Kicked { .. } | GameEvent::Over { .. } => return,
        };
        self.view.say(text, now);
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

    fn draw(&mut self) {
        self.palette.set_colliders(&self.game.scene().colliders);
        // Nothing turns a ball without friction; its pattern follows its path along the table.
        let rotation = self.roll.rotation;
        let Self { game, palette, view, .. } = self;
        draw_world(game.scene(), game.world(), palette, |_| Some(rotation), &mut view.drawing);
        view.adapt(self.dark);
    }

    /// Shows the game and its score. Returns a request of the player.
    pub fn picture(&mut self, ui: &mut Ui, studio: &mut Studio, dark: bool) -> Option<Wish> {
        self.dark = dark;
        self.counts(ui);
        let rect = ui.available_rect_before_wrap();
        self.middle = rect.center().x;
        let response = ui.allocate_rect(rect, Sense::click_and_drag());
        response
            .widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, "Pinball table"));
        let turns = self.fingers.is_empty() && response.dragged_by(PointerButton::Primary);
        let drag = if turns { response.drag_delta() } else { Vec2::ZERO };
        self.draw();
        self.view.show(ui, &response, drag, studio);
        self.over(ui)
    }

    /// Shows score, balls and what to press in a line above the picture.
    fn counts(&self, ui: &mut Ui) {
        let mut counts =
            vec![format!("Score {}", self.game.score()), format!("Balls {}", self.game.balls())];
        counts.extend(self.game.best().map(|best| format!("Best {best}")));
        let hint = match (self.game.waits(), is_touched(ui)) {
            (true, true) => "Hold a finger on the picture, and lift it to shoot.",
            (true, false) => "Hold the down arrow or S, and let go to shoot.",
            (false, true) => "Touch the left or right half to raise a flipper.",
            (false, false) => "Left and right arrow, or A and D, raise the flippers.",
        };
        count_line(ui, &counts, "Light all targets.", hint);
    }

    /// Shows the last screen. Returns a request of the player.
    fn over(&mut self, ui: &Ui) -> Option<Wish> {
        if !self.is_over() {
            return None;
        }
        let (score, best) = (self.game.score(), self.game.best().unwrap_or(0));
        let (mut again, mut wish) = (false, None);
        let card = |ui: &mut Ui| {
            ui.label(RichText::new("Game over").size(36.0).strong());
            ui.label(RichText::new(format!("{score} points")).size(18.0));
            ui.label(if score >= best {
                "The best score so far.".to_owned()
            } else {
                format!("Best score {best}.")
            });
            ui.add_space(12.0);
            again = ui.button(RichText::new("Play again").size(18.0)).clicked();
            if ui.button("Watch it as a scene").clicked() {
                wish = Some(Wish::Watch);
            }
        };
        let area = Area::new(Id::unique("over")).anchor(Align2::CENTER_CENTER, [0.0, 0.0]);
        area.show(ui.ctx(), |ui| {
            let frame = Frame::window(ui.style()).inner_margin(28.0);
            frame.show(ui, |ui| ui.vertical_centered(card));
        });
        // Enter plays again, as on every last screen.
        again |= wish.is_none()
            && ui.input_mut(|input| input.consume_key(egui::Modifiers::NONE, Key::Enter));
        if again {
            self.play_again();
        }
        wish
    }

    /// Starts to draw the present picture in this size in pixels.
    ///
    /// # Errors
    /// [`GpuError`]
    pub fn snapshot(&mut self, studio: &mut Studio, size: [u32; 2]) -> Result<Snapshot, GpuError> {
        self.draw();
        self.view.snapshot(studio, size)
    }
}
