//! The picture of a game: its camera, what is drawn, and a message over it.

use carom::DVec3;
use carom_render::{Bounds, Drawing, GpuError};
use egui::{Align2, Area, Frame, Id, Image, Pos2, Rect, Response, RichText, Ui, Vec2};

use crate::orbit::{Orbit, Preset, zoom_asked};
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

/// The picture of a game.
pub struct GameView {
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
    /// Creates the view from a direction.
    pub fn new(from: DVec3) -> Self {
        Self {
            from,
            orbit: None,
            preset: Preset::Scene,
            canvas: Canvas::default(),
            drawing: Drawing::default(),
            message: None,
        }
    }

    /// Moves the camera to a preset.
    pub fn look_from(&mut self, preset: Preset) {
        (self.orbit, self.preset) = (None, preset);
    }

    /// Adapts the drawing to a game, and to the theme.
    pub fn adapt(&mut self, dark: bool) {
        // A floor that became glass would hide where the ball may go.
        self.drawing.keeps_whole = true;
        if dark {
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

    /// Removes the message.
    pub fn say_nothing(&mut self) {
        self.message = None;
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

    /// Starts to draw the present picture in this size in pixels.
    ///
    /// # Errors
    /// [`GpuError`]
    pub fn snapshot(
        &self,
        studio: &mut Studio,
        [width, height]: [u32; 2],
    ) -> Result<Snapshot, GpuError> {
        let aspect = f64::from(width) / f64::from(height);
        let camera = self.camera(aspect).in_picture(aspect);
        Ok(Snapshot { parts: vec![studio.picture([width, height], &self.drawing, &camera)?] })
    }
}

/// Shows counts and texts in a line above the picture.
pub fn count_line(ui: &mut Ui, counts: &[String], goal: &str, hint: &str) {
    let row = |ui: &mut Ui| {
        for count in counts {
            ui.label(RichText::new(count).size(16.0).strong());
            ui.separator();
        }
        ui.label(goal);
        ui.weak(hint);
    };
    let margin = egui::Margin::symmetric(8, 3);
    Frame::new().inner_margin(margin).show(ui, |ui| ui.horizontal_wrapped(row));
}
