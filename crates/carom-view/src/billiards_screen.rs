//! The game of nine-ball on the screen: cue, table, turns and results.

use std::vec;

use carom::DVec3;
use carom_billiards::{Best, Foul, Game, GameError, Move, Stage, Table, Verdict};
use carom_render::draw_world;
use carom_scene::Palette;
use carom_scene::scene::Scene;
use carom_session::Link;
use egui::{Pos2, Rect, Response, Sense, Ui};

use crate::cue_hand::{CueHand, Played};
use crate::game_view::{GameScreen, GameView, LastScreen, Wish, count_line};
use crate::saved::SavedGame;
use crate::studio::Studio;

/// Direction from the table to the camera: from behind the head string, over the player's shoulder.
const FROM: DVec3 = DVec3::new(-0.8, 0.7, 0.0);

/// Time between two moves of a rack that is played again \[s\].
const PAUSE_SECS: f64 = 1.0;

/// A game of nine-ball that is being played.
pub struct BilliardsScreen {
    game: Game,
    palette: Palette,
    view: GameView,
    hand: CueHand,
    /// Text of the moves of the best rack.
    best_moves: Option<String>,
    /// The rack of the link that is played again.
    replay: Option<Replay>,
}

/// A recorded rack that is played again.
struct Replay {
    /// The moves that are left.
    moves: vec::IntoIter<Move>,
    /// Time until the next one \[s\].
    pause: f64,
    /// The player's own best rack.
    best: Option<Best>,
}

impl BilliardsScreen {
    /// Starts a game of one player; `link` leads to its table.
    ///
    /// # Errors
    /// If the table cannot be played on.
    pub fn new(table: Table, link: Link) -> Result<Self, GameError> {
        let palette = Palette::new(table.scene())?;
        let game = Game::new(table, 1)?;
        let view = GameView::new(FROM, link);
        let hand = CueHand::default();
        Ok(Self { game, palette, view, hand, best_moves: None, replay: None })
    }

    /// The game.
    pub fn game(&self) -> &Game {
        &self.game
    }

    /// Returns the strokes to beat, if its link states them.
    pub fn goal(&self) -> Option<f64> {
        self.view.link.goal()
    }

    /// Returns whether the rack is won.
    pub fn is_over(&self) -> bool {
        self.game.rack().stage() == Stage::Won
    }

    /// Makes a move of the player at the table.
    ///
    /// # Errors
    /// Those of [`Game::play`].
    pub fn play(&mut self, wanted: Move) -> Result<(), GameError> {
        self.game.play(wanted)
    }

    /// Returns the place of the cue ball on the screen, for a picture that fills `picture`.
    pub fn cue_ball_in(&self, picture: Rect) -> Option<Pos2> {
        self.view.projection(picture).place(self.game.cue_ball()?.1.position)
    }

    /// Returns whether a recorded rack is played again.
    pub fn is_replaying(&self) -> bool {
        self.replay.is_some()
    }

    /// Advances the balls by the time since the last frame.
    ///
    /// # Errors
    /// If the physics refuses a frame or the rules a recorded move; the game is then unchanged.
    pub fn advance(&mut self, ui: &Ui) -> Result<(), GameError> {
        let (wall_seconds, now) = ui.input(|input| (f64::from(input.unstable_dt), input.time));
        self.hand.turn_tip(ui);
        let frame_time = self.game.frame_time();
        for _ in 0..self.view.pace.frames_due(wall_seconds, frame_time) {
            self.view.clock += frame_time;
            self.replay_move(frame_time, now)?;
            let stepped = self.game.step();
            // A step that failed once would fail again.
            let verdict = stepped.inspect_err(|_| self.view.pace.set_playing(false))?;
            if let Some(verdict) = verdict {
                self.note(verdict, now);
            }
        }
        ui.ctx().request_repaint();
        Ok(())
    }

    /// Makes the next move of the rack that is played again, once its time has come. Where the moves end before the rack is
    /// won, the player begins.
    fn replay_move(&mut self, frame_time: f64, now: f64) -> Result<(), GameError> {
        let is_due = !self.game.is_rolling() && !self.is_over();
        let Some(replay) = self.replay.as_mut().filter(|_| is_due) else { return Ok(()) };
        replay.pause -= frame_time;
        if replay.pause > 0.0 {
            return Ok(());
        }
        replay.pause = PAUSE_SECS;
        let played = replay.moves.next().map(|next| self.game.play(next));
        if !matches!(played, Some(Ok(()))) {
            self.play_again();
            self.view.say("Now you".to_owned(), now);
        }
        played.unwrap_or(Ok(()))
    }

    fn note(&mut self, verdict: Verdict, now: f64) {
        self.hand.begin_turn(verdict.foul.is_some() && self.replay.is_none());
        if verdict.winner.is_some() {
            self.note_end();
            return;
        }
        let rack = self.game.rack();
        let next = (!verdict.continues && rack.players() > 1)
            .then(|| format!("player {}", rack.shooter() + 1));
        let parts = [verdict.foul.map(said), next].into_iter().flatten();
        let text = parts.collect::<Vec<_>>().join(" - ");
        if !text.is_empty() {
            self.view.say(text, now);
        }
    }

    /// Keeps the moves of the best rack; one that is played again is none of the player's.
    fn note_end(&mut self) {
        if let Some(replay) = &self.replay {
            self.game.set_best(replay.best.clone());
        }
        self.best_moves = self.game.best().map(|best| text_of(&best.moves));
    }

    /// Shows the turn and the results in a line above the picture; returns whether the user wants the recorded rack.
    fn counts(&self, ui: &mut Ui) -> bool {
        let rack = self.game.rack();
        let mut counts = match rack.players() {
            1 => vec![format!("Strokes {}", rack.strokes())],
            _ => {
                let [first, second] = self.game.racks_won();
                vec![format!("Player {}", rack.shooter() + 1), format!("Racks {first} : {second}")]
            }
        };
        if rack.players() == 1 {
            counts.extend(self.game.best().map(|best| format!("Best {}", best.strokes)));
            counts.extend(self.view.link.goal().map(|goal| format!("To beat {goal}")));
        }
        let task = format!("Hit ball {} first; pocket the nine.", rack.lowest());
        let can_watch = self.replay.is_none() && self.view.link.moves().is_some();
        count_line(ui, &counts, &task, self.hint(), can_watch)
    }

    fn hint(&self) -> &'static str {
        if self.replay.is_some() {
            return "A recorded rack; Home ends it.";
        }
        match (self.game.rack().stage(), self.hand.moves_cue_ball(&self.game)) {
            (Stage::Answer, _) => "A push-out: shoot, or leave it.",
            (Stage::Won, _) => "",
            (_, true) => "Drag the cue ball to its place, then choose Aim.",
            (_, false) => "Drag from the cue ball, and let go to strike.",
        }
    }

    /// Shows the choices of the player in a line; makes the move that was chosen.
    fn choices(&mut self, ui: &mut Ui) {
        let mut players = self.game.rack().players();
        let mut chosen = None;
        let row = |ui: &mut Ui| {
            ui.selectable_value(&mut players, 1, "One player");
            ui.selectable_value(&mut players, 2, "Two players");
            ui.separator();
            if self.replay.is_none() {
                chosen = self.hand.choices(ui, &self.game);
            }
        };
        let margin = egui::Margin::symmetric(8, 3);
        egui::Frame::new().inner_margin(margin).show(ui, |ui| ui.horizontal_wrapped(row));
        if players != self.game.rack().players() && self.game.set_players(players).is_ok() {
            self.start_again();
        }
        self.make(ui, chosen);
    }

    /// Makes a move of the player, or says why it is refused.
    fn make(&mut self, ui: &Ui, chosen: Option<Move>) {
        let Some(chosen) = chosen else { return };
        if let Err(error) = self.game.play(chosen) {
            let now = ui.input(|input| input.time);
            self.view.say(error.to_string(), now);
        }
    }

    fn start_again(&mut self) {
        self.view.start_again();
        self.hand.begin_turn(false);
        self.replay = None;
    }

    /// Handles the pointer in the picture; returns the drag that turns the camera, in points.
    fn point(&mut self, ui: &Ui, response: &Response) -> egui::Vec2 {
        let projection = self.view.projection(response.rect);
        if self.replay.is_some() {
            return response.drag_delta();
        }
        match self.hand.point(ui, response, &projection, &self.game) {
            Played::Nothing => response.drag_delta(),
            Played::Holds => egui::Vec2::ZERO,
            Played::Move(chosen) => {
                self.make(ui, Some(chosen));
                egui::Vec2::ZERO
            }
        }
    }
}

/// Returns the text of a foul.
fn said(foul: Foul) -> String {
    match foul {
        Foul::Scratch => "Foul: the cue ball left the table".to_owned(),
        Foul::NoHit => "Foul: no ball was hit".to_owned(),
        Foul::WrongBall { hit, lowest } => format!("Foul: ball {hit} was hit before ball {lowest}"),
        Foul::OffTable => "Foul: a ball left the table".to_owned(),
        Foul::WeakBreak => "Foul: fewer than four balls reached a cushion".to_owned(),
        Foul::NoRail => "Foul: no ball reached a cushion".to_owned(),
    }
}

/// Writes moves, one a line.
fn text_of(moves: &[Move]) -> String {
    moves.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
}

/// Reads moves, one a line; `None` if a line is none.
fn moves_of(text: &str) -> Option<Vec<Move>> {
    text.lines().map(|line| line.parse().ok()).collect()
}

impl GameScreen for BilliardsScreen {
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
        let rack = self.game.rack();
        let winner = rack.winner()?;
        let strokes = rack.strokes();
        let count = |strokes: u32| match strokes {
            1 => "1 stroke".to_owned(),
            _ => format!("{strokes} strokes"),
        };
        let mut lines = vec![count(strokes)];
        if self.replay.is_some() {
            lines.push("This is the rack to beat.".to_owned());
            return Some(LastScreen { heading: "Now you", lines, next: None });
        }
        if rack.players() > 1 {
            let [first, second] = self.game.racks_won();
            let heading = ["Player 1 wins", "Player 2 wins"][winner];
            return Some(LastScreen {
                heading,
                lines: vec![format!("Racks {first} : {second}")],
                next: None,
            });
        }
        let best = self.game.best().map_or(strokes, |best| best.strokes);
        lines.push(match strokes <= best {
            true => "The best rack so far.".to_owned(),
            false => format!("Best rack: {}.", count(best)),
        });
        lines.extend(self.view.link.goal().map(|goal| match f64::from(strokes) < goal {
            true => format!("You beat {goal} strokes."),
            false => format!("{goal} strokes are still to beat."),
        }));
        Some(LastScreen { heading: "The nine is down", lines, next: None })
    }

    fn best(&self) -> Option<f64> {
        self.game.best().map(|best| f64::from(best.strokes))
    }

    fn best_moves(&self) -> Option<&str> {
        self.best_moves.as_deref()
    }

    fn watch(&mut self) -> bool {
        let Some(moves) = self.view.link.moves().and_then(moves_of) else { return false };
        let best = self.game.best().cloned();
        if self.game.set_players(1).is_err() {
            return false;
        }
        self.start_again();
        self.replay = Some(Replay { moves: moves.into_iter(), pause: PAUSE_SECS, best });
        true
    }

    fn saved(&self) -> Option<SavedGame> {
        let best = self.game.best().map(|best| (best.strokes, text_of(&best.moves)));
        Some(SavedGame::Billiards { players: self.game.rack().players(), best })
    }

    fn resume(&mut self, game: &SavedGame) {
        let SavedGame::Billiards { players, best } = game else { return };
        if self.game.set_players(*players).is_err() {
            return;
        }
        let best = best
            .as_ref()
            .and_then(|(strokes, text)| Some(Best { strokes: *strokes, moves: moves_of(text)? }));
        self.best_moves = best.as_ref().map(|best| text_of(&best.moves));
        self.game.set_best(best);
    }

    fn play_again(&mut self) {
        self.game.play_again();
        self.start_again();
    }

    fn draw(&mut self) {
        let Self { game, palette, view, .. } = self;
        let own: Vec<_> = (0..10).map(|ball| palette.own(ball)).collect();
        let spheres = &game.table().scene().spheres;
        for (id, ball) in game.balls() {
            // A ball that comes back has another id.
            let first = spheres.iter().position(|it| it.user_data == u64::from(ball));
            if let Some(paint) = first.and_then(|it| own.get(it)) {
                palette.paint(id.number(), *paint);
            }
        }
        draw_world(game.table().scene(), game.world(), palette, |_| None, &mut view.drawing);
        view.adapt();
    }

    fn picture(&mut self, ui: &mut Ui, studio: &mut Studio, dark: bool) -> Option<Wish> {
        self.view.dark = dark;
        if self.counts(ui) {
            self.show_moves(ui);
        }
        self.choices(ui);
        let rect = ui.available_rect_before_wrap();
        let response = ui.allocate_rect(rect, Sense::click_and_drag());
        response
            .widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, "Billiard table"));
        self.draw();
        let drag = self.point(ui, &response);
        self.view.show(ui, &response, drag, studio);
        self.hand.draw(&ui.painter_at(rect), &self.view.projection(rect), &self.game);
        self.show_last_screen(ui)
    }
}
