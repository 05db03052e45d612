//! Small pictures of scenes, which move under the pointer.

use carom_render::{Camera, Drawing, Framing};
use carom_scene::scene::Scene;
use carom_session::{Session, View};
use egui::{Context, CornerRadius, Image, Response, Sense, Theme, Ui, Vec2};

use crate::look::{self, DrawOptions, Marks};
use crate::orbit::{Orbit, Preset};
use crate::studio::{Canvas, Studio};

/// Size of a thumbnail in points.
pub(super) const THUMBNAIL: Vec2 = Vec2::new(176.0, 99.0);

/// A thumbnail shows the scene at this part of its duration, but at most `LATEST` \[s\] after the
/// start, ...
const PART: f64 = 0.25;
const LATEST: f64 = 3.0;
/// ... and at the start if more than this many frames times spheres would be needed.
const MOST_WORK: f64 = 40_000.0;

/// Largest number of frames times spheres between two frames of the interface, which goes on
/// meanwhile.
const WORK_AT_ONCE: f64 = 2_500.0;

/// The picture of a scene.
pub(super) enum Thumbnail {
    Missing,
    Drawn {
        canvas: Box<Canvas>,
        /// Whether the theme was dark.
        dark: bool,
    },
    /// The scene cannot be read.
    Impossible,
}

impl Thumbnail {
    /// Returns whether a picture can be drawn that is not there yet in this theme.
    pub fn is_wanted(&self, dark: bool) -> bool {
        match self {
            Self::Missing => true,
            Self::Drawn { dark: drawn, .. } => *drawn != dark,
            Self::Impossible => false,
        }
    }

    /// Paints the picture in a place of this size; returns the response of the place.
    pub fn show(&self, ui: &mut Ui, size: Vec2, sense: Sense) -> Response {
        let (rect, response) = ui.allocate_exact_size(size, sense);
        let canvas = match self {
            Self::Drawn { canvas, .. } => canvas.texture(),
            Self::Missing | Self::Impossible => None,
        };
        match canvas {
            Some(texture) => {
                Image::new((texture, size)).corner_radius(4).paint_at(ui, rect);
            }
            None => {
                let color = ui.visuals().faint_bg_color;
                ui.painter().rect_filled(rect, CornerRadius::same(4), color);
            }
        }
        response
    }
}

/// A scene that runs in its thumbnail.
pub(super) struct Running {
    session: Session,
    view: View,
    drawing: Drawing,
    framing: Framing,
    camera: Camera,
    duration: f64,
    /// Time that has passed since the last frame of the scene \[s\].
    owed: f64,
    /// Frames until the picture at rest.
    to_picture: u64,
}

impl Running {
    /// Opens a scene with its own camera; `None` if it is invalid.
    pub fn new(scene: &Scene) -> Option<Self> {
        let session = Session::new(scene.clone()).ok()?;
        let (mut view, mut drawing) = (View::default(), Drawing::default());
        session.fill(&mut view);
        draw_into(&view, false, &mut drawing);
        let framing = Framing::of_run(Framing::of_scene(scene), &drawing);
        let aspect = f64::from(THUMBNAIL.x / THUMBNAIL.y);
        let of_scene = Camera::of_scene(scene);
        let camera = Orbit::preset(Preset::Scene, of_scene, &framing.whole, aspect).camera;
        let duration = scene.simulation.duration;
        let frames = ((PART * duration).min(LATEST) / session.frame_time()).floor();
        let is_quick = frames * session.world().spheres().len().max(1) as f64 <= MOST_WORK;
        let to_picture = if is_quick { frames as u64 } else { 0 };
        Some(Self { session, view, drawing, framing, camera, duration, owed: 0.0, to_picture })
    }

    /// Moves on towards the picture at rest; returns whether it is reached.
    pub fn prepare(&mut self) -> bool {
        let count = self.frames_at_once().min(self.to_picture);
        self.to_picture -= count;
        // If a step fails, the state before it is drawn.
        let is_going = (0..count).try_for_each(|_| self.session.step()).is_ok();
        self.to_picture == 0 || !is_going
    }

    /// Moves on by the time since the last picture \[s\], as far as there is time for it. The scene
    /// begins again at its end.
    pub fn advance(&mut self, seconds: f64) {
        let (frame_time, most) = (self.session.frame_time(), self.frames_at_once() as f64);
        self.owed = (self.owed + seconds).min(most * frame_time);
        while self.owed >= frame_time {
            self.owed -= frame_time;
            if self.session.time() >= self.duration || self.session.step().is_err() {
                self.session.seek(0);
                // The beginning needs no step.
                let _ = self.session.advance_seek(0);
            }
        }
    }

    /// Returns the largest number of frames between two frames of the interface.
    fn frames_at_once(&self) -> u64 {
        let spheres = self.session.world().spheres().len().max(1);
        (WORK_AT_ONCE / spheres as f64).max(1.0) as u64
    }

    /// Draws the present state in the theme of the interface.
    pub fn draw(&mut self, studio: &mut Studio, canvas: &mut Canvas, context: &Context) {
        self.session.fill(&mut self.view);
        draw_into(&self.view, is_dark(context), &mut self.drawing);
        self.drawing.framing = Some(self.framing);
        studio.draw(canvas, THUMBNAIL * context.pixels_per_point(), &self.drawing, &self.camera);
    }
}

/// Returns whether the theme is dark.
pub(super) fn is_dark(context: &Context) -> bool {
    context.theme() == Theme::Dark
}

fn draw_into(view: &View, dark: bool, drawing: &mut Drawing) {
    let look = DrawOptions { marks: Marks::default(), dark, blend: 1.0, picked: None };
    look::draw(view, &look, drawing);
}
