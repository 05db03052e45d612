//! The screen of a watched scene: its picture and panels.

mod aim;
mod card;
mod comparison;
mod cue;
mod departures;
mod entries;
mod grab;
mod hand;
mod held_surface;
mod hints;
mod marker;
mod over;
mod sides;
mod surface;
mod text;
mod verdict;
mod viewpoint;

use std::sync::Arc;
use std::time::Duration;

use carom::{ColliderId, DVec3, SphereId};
use carom_render::{Camera, Drawing, GpuError};
use carom_scene::Source;
use carom_scene::scene::Scene;
use carom_session::{Command, Driver, Link, LinkSource, Session, SessionError, View, Watched};
use egui::{Image, Pos2, Rect, Sense, Ui, Vec2};
use web_time::Instant;

use crate::action::Action;
use crate::inspector::{self, Throw};
use crate::layout::{Beside, has_sheets};
use crate::look::{self, DrawOptions};
use crate::orbit::Preset;
use crate::plots;
use crate::saved::{Layout, Panels};
use crate::snapshot::Snapshot;
use crate::studio::{Canvas, Studio};
use crate::written_scene::WrittenScene;
use crate::{impact_list, transport};
use card::Card;
use cue::Cue;
use departures::Departures;
pub use entries::PRESETS;
use grab::Grab;
use held_surface::HeldSurface;
use hints::{Restarted, Way};
pub use marker::three_digits;
use sides::side_of;
use viewpoint::Viewpoint;

/// The screen of a watched scene.
pub struct Watching {
    driver: Driver,
    /// Longest time for the physics in a frame, on this thread; `None` if it has a thread of its own.
    inline_budget: Option<Duration>,
    /// Origin of the scene.
    pub source: Source,
    /// A link to the beginning of the scene, and the scene that it was made from.
    link: (Arc<Scene>, Link),
    /// The text that the scene was read from, if there is one.
    written: Option<WrittenScene>,
    /// Whether the view shows the scene in `written`.
    shows_text: bool,
    /// Commands of this frame, sent at its end.
    pub commands: Vec<Command>,
    viewpoint: Viewpoint,
    /// The seek in progress.
    way: Option<Way>,
    restarted: Option<Restarted>,
    departures: Departures,
    /// Time at the last frame, by the clock of the interface \[s\].
    clock: f64,
    layout: Layout,
    /// Whether panels were sheets in the last frame.
    has_sheets: bool,
    /// The open sheet of such a window.
    sheet: Panels,
    throw: Throw,
    /// The newest ball before a throw whose ball is to be picked.
    thrown_after: Option<Option<SphereId>>,
    card: Card,
    /// The ball in the hand.
    grabbed: Option<Grab>,
    /// The picked surface.
    surface: Option<ColliderId>,
    held_surface: Option<HeldSurface>,
    /// The cue in the hand.
    cue: Option<Cue>,
    /// The pictures of both rules; one rule uses the first.
    canvases: [Canvas; 2],
    drawing: Drawing,
    drawn: [Option<Drawn>; 2],
    news: u64,
    /// What the user wants to save of the plots.
    pub wanted: Option<plots::Wanted>,
    /// Error of a refused command, until a notice shows it.
    pub refused: Option<SessionError>,
}

/// Everything that a picture depends on; a change redraws it.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Drawn {
    news: u64,
    camera: Camera,
    look: DrawOptions,
    size: Vec2,
}

/// Settings of the interface that do not depend on the scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Manner {
    /// Whether the theme is dark.
    pub dark: bool,
    /// Whether a film is being recorded.
    pub recording: bool,
    /// Whether the card of the scene has its place.
    pub has_card: bool,
}

const INSPECTOR: Beside = Beside { title: "Settings", is_right: true, widths: [300.0; 3] };
const PLOTS: Beside = Beside { title: "Plots", is_right: false, widths: [200.0, 330.0, 700.0] };

impl Watching {
    /// Starts to watch a scene.
    ///
    /// # Errors
    /// If the scene is invalid, or no thread can be started.
    pub fn new(
        scene: Scene,
        source: Source,
        inline_budget: Option<Duration>,
        context: &egui::Context,
    ) -> Result<Self, SessionError> {
        let link = Link::to_scene(&scene);
        Self::at(Session::new(scene)?, link, source, inline_budget, context)
    }

    /// Starts to watch the run of a link, and seeks to its time.
    ///
    /// # Errors
    /// If the link is invalid, or no thread can be started.
    pub fn replay(
        link: &Link,
        scene: Scene,
        inline_budget: Option<Duration>,
        context: &egui::Context,
    ) -> Result<Self, SessionError> {
        let runs = Watched::replay(scene, link)?;
        let source = match link.source() {
            LinkSource::BuiltIn(_) => Source::BuiltIn,
            LinkSource::File { .. } => Source::Registered,
        };
        let mut watching = Self::at(runs, link.clone(), source, inline_budget, context)?;
        if let LinkSource::File { name, text } = link.source() {
            watching.written = WrittenScene::new(name, text, link.overrides().to_vec()).ok();
            watching.shows_text = watching.written.is_some();
        }
        if let Some(place) = link.camera() {
            watching.viewpoint = Viewpoint::at(place);
        }
        watching.commands.push(Command::ShowStateHash(true));
        Ok(watching)
    }

    /// Returns a sentence about the hardest impact after a time \[s\]; `None` without one.
    pub fn hardest_impact_after(&self, time: f64) -> Option<String> {
        impact_list::hardest_after(self.view(), time)
    }

    fn at(
        watched: impl Into<Watched>,
        link: Link,
        source: Source,
        inline_budget: Option<Duration>,
        context: &egui::Context,
    ) -> Result<Self, SessionError> {
        let driver = driver(watched.into(), inline_budget, context)?;
        let throw = Throw::like_those_of(driver.view());
        Ok(Self {
            link: (driver.view().scene.clone(), link),
            driver,
            inline_budget,
            source,
            written: None,
            shows_text: false,
            commands: Vec::new(),
            viewpoint: Viewpoint::new(),
            way: None,
            restarted: None,
            departures: Departures::default(),
            clock: 0.0,
            layout: Layout::default(),
            has_sheets: false,
            sheet: Panels::NONE,
            throw,
            thrown_after: None,
            card: Card::default(),
            grabbed: None,
            surface: None,
            held_surface: None,
            cue: None,
            canvases: Default::default(),
            drawing: Drawing::default(),
            drawn: [None; 2],
            news: 0,
            wanted: None,
            refused: None,
        })
    }

    /// Returns the view.
    pub fn view(&self) -> &View {
        self.driver.view()
    }

    /// Returns the camera of the last picture, before it adapts to the shape of the window.
    pub fn camera(&self) -> Option<Camera> {
        self.viewpoint.orbit().map(|orbit| orbit.camera)
    }

    /// Returns the layout.
    pub fn layout(&self) -> Layout {
        self.layout
    }

    /// Sets the layout.
    pub fn set_layout(&mut self, layout: Layout) {
        self.layout = layout;
        self.commands.push(Command::ShowContacts(layout.marks.forces));
    }

    /// Returns the view, and a link to the beginning of its scene with the present camera.
    pub fn linked(&mut self) -> (&View, &Link) {
        let view = self.driver.view();
        if !Arc::ptr_eq(&self.link.0, &view.scene) {
            let written = self.written.as_ref().filter(|it| *it.scene() == *view.scene);
            self.shows_text = written.is_some();
            let link = written.map_or_else(|| Link::to_scene(&view.scene), WrittenScene::link);
            self.link = (view.scene.clone(), link);
        }
        let camera = self.viewpoint.for_link();
        if self.link.1.camera() != camera {
            self.link.1.set_camera(camera);
        }
        (view, &self.link.1)
    }

    /// Advances the physics by the time since the last frame.
    pub fn advance(&mut self, ui: &Ui) {
        let wall_seconds = ui.input(|input| f64::from(input.unstable_dt));
        self.clock = ui.input(|input| input.time);
        let began = Instant::now();
        let time_is_up = || self.inline_budget.is_some_and(|budget| began.elapsed() > budget);
        if self.driver.update(wall_seconds, time_is_up) {
            self.news += 1;
            self.pick_thrown();
            let framing = self.viewpoint.framing(&self.driver.view().scene);
            self.departures.note(self.driver.view(), framing);
        }
        let playback = &self.view().playback;
        if playback.playing || self.view().seeking.is_some() || playback.blend < 1.0 {
            ui.ctx().request_repaint();
        }
    }

    /// Performs an action, if it concerns this scene.
    pub fn act(&mut self, action: Action) {
        let view = self.driver.view();
        let speed = view.playback.speed;
        match action {
            Action::PlayOrPause if view.playback.playing => self.commands.push(Command::Pause),
            Action::PlayOrPause => self.commands.push(Command::Play),
            Action::Step => self.commands.push(Command::Step),
            Action::StepBack => self.commands.push(Command::StepBack),
            Action::Restart => self.restart(false),
            Action::RestartWithValues => self.restart(true),
            Action::Undo | Action::Redo => {
                self.restarted = None;
                let is_undo = action == Action::Undo;
                self.commands.push(if is_undo { Command::Undo } else { Command::Redo });
            }
            Action::Faster | Action::Slower => {
                let next = transport::next_speed(speed, action == Action::Faster);
                self.commands.push(Command::Speed(next));
            }
            Action::Throw => self.throw_ahead(),
            Action::SceneCamera => self.viewpoint.look_from(Preset::Scene),
            Action::FrontCamera => self.viewpoint.look_from(Preset::Front),
            Action::TopCamera => self.viewpoint.look_from(Preset::Top),
            Action::Fit => self.viewpoint.toggle_fit(),
            Action::Follow => self.viewpoint.toggle_follow(self.picked_place()),
            Action::Inspector | Action::Plots | Action::Impacts => self.toggle_panel(action),
            Action::Velocities => self.layout.marks.velocities ^= true,
            Action::Contacts => self.layout.marks.contacts ^= true,
            Action::Forces => {
                self.layout.marks.forces ^= true;
                self.commands.push(Command::ShowContacts(self.layout.marks.forces));
            }
            Action::Compare => self.compare(),
            Action::Nudge => self.nudge(),
            _ => {}
        }
    }

    /// Restarts the scene, and remembers it for the hint about edits.
    fn restart(&mut self, with_values: bool) {
        self.commands.push(if with_values { Command::RestartWithValues } else { Command::Restart });
        let is_edited = self.view().edits.last().is_some_and(|time| *time > 0.0);
        self.restarted = is_edited.then_some(Restarted { with_values, at: self.clock });
    }

    fn toggle_panel(&mut self, action: Action) {
        // A small window has space for one panel; the layout of large ones is kept.
        let before = if self.has_sheets { self.sheet } else { self.layout.panels };
        let is_one = |of: Action, is_open: bool| {
            if of == action { !is_open } else { is_open && !self.has_sheets }
        };
        let after = Panels {
            inspector: is_one(Action::Inspector, before.inspector),
            plots: is_one(Action::Plots, before.plots),
            impacts: is_one(Action::Impacts, before.impacts),
        };
        *(if self.has_sheets { &mut self.sheet } else { &mut self.layout.panels }) = after;
    }

    fn picked_place(&self) -> Option<DVec3> {
        let view = self.view();
        let index = view.spheres.index_of(view.picked?)?;
        Some(look::place(view, index, self.driver.blend()))
    }

    /// Shows the bar that plays the scene. Returns the actions of its buttons.
    pub fn transport(&mut self, ui: &mut Ui, manner: Manner) -> Vec<Action> {
        let (view, commands) = (self.driver.view(), &mut self.commands);
        let shown = egui::Panel::bottom("transport").show(ui, |ui| {
            ui.add_space(3.0);
            let actions = transport::show(ui, view, manner.recording, commands);
            ui.add_space(3.0);
            actions
        });
        shown.inner
    }

    /// Shows the panels around the picture.
    pub fn panels(&mut self, ui: &mut Ui) {
        self.has_sheets = has_sheets(ui);
        let parameters = self.parameters();
        let Self { driver, commands, layout, throw, departures, wanted, sheet, surface, .. } = self;
        let mut changed = None;
        let Layout { panels, plots, .. } = layout;
        let panels = if self.has_sheets { sheet } else { panels };
        let view = driver.view();
        let whole = ui.available_size();
        let mut room = 0.5 * whole.x;
        INSPECTOR.show(ui, &mut room, &mut panels.inspector, |ui| {
            changed = inspector::show(ui, view, &parameters, throw, surface, commands);
        });
        PLOTS.show(ui, &mut room, &mut panels.plots, |ui| {
            *wanted = plots::show(ui, view, departures.since(), plots);
        });
        if panels.impacts {
            egui::Panel::bottom("impacts")
                .resizable(true)
                .default_size(170.0_f32.min(0.4 * whole.y))
                .size_range(60.0..=0.5 * whole.y)
                .show(ui, |ui| impact_list::show(ui, view, commands));
        }
        if let Some(parameter) = changed {
            self.set_parameter(&parameter);
        }
    }

    /// Returns the camera for the next picture with this ratio of width to height, `seconds` after
    /// the last one.
    fn next_camera(&mut self, aspect: f64, seconds: f64) -> Camera {
        let (picked, blend) = (self.picked_place(), self.driver.blend());
        let view = self.driver.view();
        let orbit = self.viewpoint.next(view, blend, picked, (aspect, seconds));
        orbit.in_picture(aspect)
    }

    /// Shows the picture, or two side by side. Returns the actions of the buttons over it.
    pub fn picture(&mut self, ui: &mut Ui, studio: &mut Studio, manner: Manner) -> Vec<Action> {
        let whole = ui.available_rect_before_wrap();
        let count = if self.view().other.is_some() { 2 } else { 1 };
        let width = whole.width() / count as f32;
        for side in 0..count {
            let left = whole.left() + side as f32 * width;
            let rect =
                Rect::from_min_size(Pos2::new(left, whole.top()), Vec2::new(width, whole.height()));
            let response = ui.allocate_rect(rect, Sense::click_and_drag());
            self.hand(ui, &response, side);
            self.draw(ui, studio, manner, side, rect);
            response.widget_info(|| egui::WidgetInfo {
                current_text_value: marker::label(side_of(self.driver.view(), side)),
                ..egui::WidgetInfo::labeled(egui::Role::Image, true, "Scene")
            });
        }
        let actions = self.hints(ui, whole);
        if manner.has_card {
            self.card(ui, whole);
        }
        self.send();
        actions
    }

    fn look(&self, manner: Manner) -> DrawOptions {
        let (marks, blend) = (self.layout.marks, self.driver.blend());
        DrawOptions { marks, dark: manner.dark, blend, picked: self.surface }
    }

    /// Draws the picture of one rule, if anything in it has changed.
    fn draw(&mut self, ui: &mut Ui, studio: &mut Studio, manner: Manner, side: usize, rect: Rect) {
        let size = rect.size() * ui.ctx().pixels_per_point();
        if size.x < 1.0 || size.y < 1.0 {
            return;
        }
        let aspect = f64::from(size.x / size.y);
        let seconds = ui.input(|input| f64::from(input.stable_dt));
        let camera = self.next_camera(aspect, seconds);
        let look = self.look(manner);
        let drawn = Drawn { news: self.news, camera, look, size };
        if self.drawn[side] != Some(drawn) {
            if self.viewpoint.fits() {
                // The camera may still be moving.
                ui.ctx().request_repaint();
            }
            let view = self.driver.view();
            self.drawing.framing = self.viewpoint.framing(&view.scene);
            look::draw(side_of(view, side), &look, &mut self.drawing);
            studio.draw(&mut self.canvases[side], size, &self.drawing, &camera);
            self.drawn[side] = Some(drawn);
        }
        if let Some(texture) = self.canvases[side].texture() {
            Image::new((texture, rect.size())).paint_at(ui, rect);
        }
        if let Some(projection) = self.projection(rect) {
            let (view, blend) = (side_of(self.driver.view(), side), self.driver.blend());
            marker::draw(&ui.painter_at(rect), view, blend, &projection);
            self.draw_aim(&ui.painter_at(rect), &projection, side);
        }
        if self.view().other.is_some() {
            sides::show(ui, rect, self.driver.view(), side, &mut self.commands);
        }
    }

    /// Sends the commands of this frame.
    fn send(&mut self) {
        for command in self.commands.drain(..) {
            if let Err(error) = self.driver.send(command) {
                self.refused = Some(error);
            }
        }
    }

    /// Starts to draw the present picture in this size in pixels.
    ///
    /// # Errors
    /// [`GpuError`]
    pub fn snapshot(
        &mut self,
        studio: &mut Studio,
        manner: Manner,
        [width, height]: [u32; 2],
    ) -> Result<Snapshot, GpuError> {
        let look = self.look(manner);
        let count = if self.view().other.is_some() { 2 } else { 1 };
        let size = [width / count, height];
        let camera = self.next_camera(f64::from(size[0]) / f64::from(size[1]), 0.0);
        let Self { driver, drawing, .. } = self;
        let view = driver.view();
        let sides: Vec<&View> = [Some(view), view.other.as_deref()].into_iter().flatten().collect();
        let mut parts = Vec::new();
        for side in sides {
            look::draw(side, &look, drawing);
            parts.push(studio.picture(size, drawing, &camera)?);
        }
        Ok(Snapshot { parts })
    }
}

fn driver(
    watched: Watched,
    inline_budget: Option<Duration>,
    context: &egui::Context,
) -> Result<Driver, SessionError> {
    #[cfg(not(target_arch = "wasm32"))]
    if inline_budget.is_none() {
        let context = context.clone();
        return Driver::threaded(watched, Box::new(move || context.request_repaint()));
    }
    let _ = (inline_budget, context);
    Ok(Driver::inline(watched))
}
