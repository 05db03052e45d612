//! What all games have on the screen: a picture, a pace, a link and a last screen.

use carom::DVec3;
use carom_render::{Bounds, Drawing, GpuError, Roll};
use carom_scene::scene::Scene;
use carom_session::{Link, Pace};
use egui::{
    Align2, Area, Frame, Id, Image, Key, Modifiers, Pos2, Rect, Response, RichText, Ui, Vec2,
};

use crate::action::Action;
use crate::orbit::{Orbit, Preset, zoom_asked};
use crate::projection::Projection;
use crate::saved::SavedGame;
use crate::snapshot::Snapshot;
use crate::studio::{Canvas, Studio};

/// How long a message is shown \[s\].
const MESSAGE_SECS: f64 = 2.0;

/// Requests of the player that leave the present game.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Wish {
    /// Watch the game as a scene, with all its values.
    Watch,
    /// Play another game.
    Next,
}

/// A game on the screen.
pub trait GameScreen {
    /// Returns picture, pace and link of the game.
    fn view(&self) -> &GameView;

    /// Returns picture, pace and link of the game, to change them.
    fn view_mut(&mut self) -> &mut GameView;

    /// Returns the title for display.
    fn title(&self) -> &str;

    /// Returns the scene of the game at its start.
    fn scene(&self) -> &Scene;

    /// Returns the time played \[s\].
    fn elapsed(&self) -> f64;

    /// Returns the last screen, once the game is over.
    fn last_screen(&self) -> Option<LastScreen>;

    /// Returns the best result of all games: points, or a time \[s\].
    fn best(&self) -> Option<f64>;

    /// Returns what is kept of the game between starts.
    fn saved(&self) -> Option<SavedGame>;

    /// Continues an earlier game.
    fn resume(&mut self, game: &SavedGame);

    /// Starts again, and keeps the best result.
    fn play_again(&mut self);

    /// Draws the present state into the view.
    fn draw(&mut self);

    /// Shows the game. Returns a request of the player.
    fn picture(&mut self, ui: &mut Ui, studio: &mut Studio, dark: bool) -> Option<Wish>;

    /// Returns the text of the moves that reached the best result, if they are known.
    fn best_moves(&self) -> Option<&str> {
        None
    }

    /// Plays the game of the link again; returns whether its moves can be read.
    fn watch(&mut self) -> bool {
        false
    }

    /// Plays the game of the link again, or says why not.
    fn show_moves(&mut self, ui: &Ui) {
        if !self.watch() {
            let now = ui.input(|input| input.time);
            self.view_mut().say("The moves of the link cannot be read".to_owned(), now);
        }
    }

    /// Returns a link to the game with the best result as the one to beat, and the moves that reached it.
    fn challenge(&self) -> Link {
        let link = self.view().link.clone();
        let best = self.best().map(|best| link.clone().without_goal().with_goal(best));
        let Some(challenge) = best.and_then(Result::ok) else { return link };
        let moves = self.best_moves().map(|moves| challenge.clone().with_moves(moves));
        moves.and_then(Result::ok).unwrap_or(challenge)
    }

    /// Performs the action of a key or button.
    fn act(&mut self, action: Action) {
        let view = self.view_mut();
        match action {
            Action::PlayOrPause => view.pace.set_playing(!view.pace.is_playing()),
            Action::Restart => self.play_again(),
            Action::SceneCamera => view.look_from(Preset::Scene),
            Action::FrontCamera => view.look_from(Preset::Front),
            Action::TopCamera => view.look_from(Preset::Top),
            _ => {}
        }
    }

    /// Shows the last screen once the game is over, on which Enter plays again. Returns a request of the player.
    fn show_last_screen(&mut self, ui: &Ui) -> Option<Wish> {
        let mut choice = self.last_screen()?.show(ui);
        if choice.is_none() && ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Enter))
        {
            choice = Some(Choice::Again);
        }
        match choice? {
            Choice::Leave(wish) => Some(wish),
            Choice::Again => {
                self.play_again();
                None
            }
        }
    }

    /// Starts to draw the present picture in this size in pixels.
    ///
    /// # Errors
    /// [`GpuError`]
    fn snapshot(&mut self, studio: &mut Studio, size: [u32; 2]) -> Result<Snapshot, GpuError> {
        self.draw();
        self.view().snapshot(studio, size)
    }
}

/// What is shown once a game is over.
pub struct LastScreen {
    pub heading: &'static str,
    /// The result, and what else is to be said.
    pub lines: Vec<String>,
    /// Text of the button to another game, if there is one.
    pub next: Option<&'static str>,
}

/// What the player chose on the last screen.
#[derive(Debug, Clone, Copy)]
enum Choice {
    Again,
    Leave(Wish),
}

impl LastScreen {
    /// Shows the last screen. Returns what the player chose.
    fn show(&self, ui: &Ui) -> Option<Choice> {
        let mut choice = None;
        let card = |ui: &mut Ui| {
            ui.label(RichText::new(self.heading).size(44.0).strong());
            for (i, line) in self.lines.iter().enumerate() {
                let text = RichText::new(line);
                ui.label(if i == 0 { text.size(18.0) } else { text });
            }
            ui.add_space(12.0);
            if ui.button(RichText::new("Play again").size(18.0)).clicked() {
                choice = Some(Choice::Again);
            }
            if let Some(next) = self.next
                && ui.button(RichText::new(next).size(18.0)).clicked()
            {
                choice = Some(Choice::Leave(Wish::Next));
            }
            if ui.button("Watch it as a scene").clicked() {
                choice = Some(Choice::Leave(Wish::Watch));
            }
        };
        let area = Area::new(Id::unique("last screen")).anchor(Align2::CENTER_CENTER, [0.0, 0.0]);
        area.show(ui.ctx(), |ui| {
            let frame = Frame::window(ui.style()).inner_margin(28.0);
            frame.show(ui, |ui| ui.vertical_centered(card));
        });
        choice
    }
}

/// Picture, pace and link of a game.
pub struct GameView {
    /// A link to the game.
    pub link: Link,
    pub pace: Pace,
    /// Time played, including the last screen \[s\]; films follow it.
    pub clock: f64,
    /// Turn of the ball's pattern by its path.
    pub roll: Roll,
    /// Whether the theme is dark.
    pub dark: bool,
    /// Direction from the game to the camera.
    from: DVec3,
    /// `None` until there is a picture to fit the game into.
    orbit: Option<Orbit>,
    /// The preset that the camera starts from.
    preset: Preset,
    canvas: Canvas,
    /// What is drawn: the game fills it before each picture.
    pub drawing: Drawing,
    /// Last message, and the time until which it is shown, by the clock of the interface \[s\].
    message: Option<(String, f64)>,
}

impl GameView {
    /// Creates the view of a game that is played, from a direction.
    pub fn new(from: DVec3, link: Link) -> Self {
        let mut pace = Pace::new();
        pace.set_playing(true);
        Self {
            link,
            pace,
            clock: 0.0,
            roll: Roll::START,
            dark: false,
            from,
            orbit: None,
            preset: Preset::Scene,
            canvas: Canvas::default(),
            drawing: Drawing::default(),
            message: None,
        }
    }

    /// Moves the camera to a preset.
    fn look_from(&mut self, preset: Preset) {
        (self.orbit, self.preset) = (None, preset);
    }

    /// Follows a game that starts again.
    pub fn start_again(&mut self) {
        self.roll = Roll::START;
        self.message = None;
    }

    /// Adapts the drawing to a game, and to the theme.
    pub fn adapt(&mut self) {
        // A floor that became glass would hide where the ball may go.
        self.drawing.keeps_whole = true;
        if self.dark {
            self.drawing.light = self.drawing.light.at_dusk();
        }
    }

    /// Returns the camera for a picture with this ratio of width to height.
    fn camera(&self, aspect: f64) -> Orbit {
        let fitted = || {
            let bounds = self.drawing.bounds().unwrap_or(Bounds::UNIT);
            match self.preset {
                Preset::Scene => Orbit::fitted(&bounds, self.from, aspect),
                preset => Orbit::preset(preset, None, &bounds, aspect),
            }
        };
        self.orbit.unwrap_or_else(fitted)
    }

    /// Shows the drawing in `rect`, after the camera followed the pointer: turned by `drag`, in points, and zoomed.
    pub fn show(&mut self, ui: &Ui, response: &Response, drag: Vec2, studio: &mut Studio) {
        let rect = response.rect;
        let size = rect.size() * ui.ctx().pixels_per_point();
        if size.x < 1.0 || size.y < 1.0 {
            return;
        }
        let aspect = f64::from(size.x / size.y);
        let mut orbit = self.camera(aspect);
        let drag = drag / rect.height().max(1.0);
        let [right, up] = [drag.x, -drag.y].map(|it| std::f64::consts::PI * f64::from(it));
        orbit.turn(right, up);
        if response.hovered() {
            orbit.zoom(zoom_asked(ui));
        }
        self.orbit = Some(orbit);
        studio.draw(&mut self.canvas, size, &self.drawing, &orbit.in_picture(aspect));
        if let Some(texture) = self.canvas.texture() {
            Image::new((texture, rect.size())).paint_at(ui, rect);
        }
        self.show_message(ui, rect);
    }

    /// Shows a message for some seconds from `now` \[s\] on, by the clock of the interface.
    pub fn say(&mut self, text: String, now: f64) {
        self.message = Some((text, now + MESSAGE_SECS));
    }

    fn show_message(&self, ui: &Ui, rect: Rect) {
        let now = ui.input(|input| input.time);
        let Some((text, _)) = self.message.as_ref().filter(|(_, until)| now < *until) else {
            return;
        };
        let place: Pos2 = rect.center_top() + Vec2::new(0.0, 16.0);
        let area = Area::new(Id::unique("what happened")).interactable(false);
        area.pivot(Align2::CENTER_TOP).fixed_pos(place).show(ui.ctx(), |ui| {
            let frame = Frame::window(ui.style());
            frame.show(ui, |ui| ui.label(RichText::new(text).size(26.0).strong()));
        });
    }

    /// Returns where points are in the picture in `rect`.
    pub fn projection(&self, rect: Rect) -> Projection {
        let aspect = f64::from(rect.width() / rect.height());
        Projection { camera: self.camera(aspect).in_picture(aspect), rect }
    }

    /// Starts to draw the present picture in this size in pixels.
    fn snapshot(
        &self,
        studio: &mut Studio,
        [width, height]: [u32; 2],
    ) -> Result<Snapshot, GpuError> {
        let aspect = f64::from(width) / f64::from(height);
        let camera = self.camera(aspect).in_picture(aspect);
        Ok(Snapshot { parts: vec![studio.picture([width, height], &self.drawing, &camera)?] })
    }
}

/// Shows counts and texts in a line above the picture, and the button of a recorded game if there is one; returns whether
/// the button was clicked.
pub fn count_line(ui: &mut Ui, counts: &[String], goal: &str, hint: &str, can_watch: bool) -> bool {
    let mut is_clicked = false;
    let row = |ui: &mut Ui| {
        for count in counts {
            ui.label(RichText::new(count).size(16.0).strong());
            ui.separator();
        }
        is_clicked = can_watch && ui.button("Watch it").clicked();
        ui.label(goal);
        ui.weak(hint);
    };
    let margin = egui::Margin::symmetric(8, 3);
    Frame::new().inner_margin(margin).show(ui, |ui| ui.horizontal_wrapped(row));
    is_clicked
}
