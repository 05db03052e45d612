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
        Ok(Self { game, palette, view, fingers: BTreeMap::new(), middle: 0.0 })
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
        let keys = self.keys(ui);
        let (wall_seconds, now) = ui.input(|input| (f64::from(input.unstable_dt), input.time));
        for _ in 0..self.view.pace.frames_due(wall_seconds, self.game.frame_time()) {
            self.view.clock += self.game.frame_time();
            let before = self.ball();
            let stepped = self.game.step(keys).map(<[_]>::to_vec);
            // A step that failed once would fail again.
            let events = stepped.inspect_err(|_| self.view.pace.set_playing(false))?;
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

    /// Shows score, balls and what to press in a line above the picture.
    fn counts(&self, ui: &mut Ui) {
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
        count_line(ui, &counts, "Light all targets.", hint);
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
        self.game.best().map(|best| SavedGame::Pinball { best })
    }

    fn resume(&mut self, game: &SavedGame) {
        if let SavedGame::Pinball { best } = game {
            self.game.set_best(Some(*best));
        }
    }

    fn play_again(&mut self) {
        self.game.play_again();
        self.view.start_again();
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
        self.show_last_screen(ui)
    }
}
