//! Hints over the picture of a scene: how to begin, the progress of a seek, where the balls are.

use carom_render::Camera;
use carom_session::{Command, View};
use egui::{Align2, Area, Button, Frame, Id, Label, Rect, RichText, Role, Ui, Vec2, WidgetInfo};
use web_time::Instant;

use crate::action::Action;
use crate::layout::is_compact;

/// Width of the text about a seek, in points.
const WAY_WIDTH: f32 = 270.0;

/// Progress of a seek to another time.
#[derive(Debug, Clone, Copy)]
pub(super) struct Way {
    target: u64,
    from: u64,
    since: Instant,
}

/// A restart, and what it did with the edits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Restarted {
    /// Whether the scene starts with the edited values; else the edits happen again at their times.
    pub with_values: bool,
    /// Time of the restart, by the clock of the interface \[s\].
    pub at: f64,
}

/// What the hints depend on.
#[derive(Debug, Clone, Copy)]
pub(super) struct HintState<'a> {
    pub way: Option<&'a Way>,
    pub restarted: Option<Restarted>,
    /// How long the physics thread has been computing without a result \[s\].
    pub seconds_at_work: f64,
}

/// A frame shorter than this has no hint \[s\].
const LONG: f64 = 0.7;

/// How long the hint about a restart is shown \[s\].
const TOLD: f64 = 7.0;

/// A seek shorter than this has no hint \[s\].
const SHORT: f64 = 0.5;

impl Way {
    /// Returns the seek of a view; `before` is that of the last frame.
    pub fn of(view: &View, before: Option<Self>) -> Option<Self> {
        let target = view.seeking?;
        let same = before.filter(|it| it.target == target && it.from <= view.frame);
        Some(same.unwrap_or_else(|| Self { target, from: view.frame, since: Instant::now() }))
    }

    /// Returns the text about the seek; `None` while it is short.
    fn text(&self, view: &View) -> Option<String> {
        let seconds = self.since.elapsed().as_secs_f64();
        let (done, all) = (view.frame - self.from, self.target.saturating_sub(self.from));
        if seconds < SHORT || all == 0 {
            return None;
        }
        let part = done as f64 / all as f64;
        let end = self.target as f64 * view.setup.simulation.frame_time;
        let left = seconds * (1.0 - part) / part.max(1e-9);
        let percent = (100.0 * part).floor();
        let left = if done == 0 { String::new() } else { format!(", {} left", duration(left)) };
        Some(format!("{percent:.0} % of the way to {end:.1} s{left}"))
    }
}

/// Returns the text of a duration \[s\], rounded as people do.
fn duration(seconds: f64) -> String {
    match seconds {
        s if s < 90.0 => format!("about {:.0} s", s.max(1.0)),
        s if s < 5400.0 => format!("about {:.0} min", s / 60.0),
        s if s < 172_800.0 => format!("about {:.0} h", s / 3600.0),
        _ => "more than two days".to_owned(),
    }
}

/// Returns whether there are balls but none is visible.
fn all_have_left(view: &View, camera: &Camera, aspect: f64) -> bool {
    // Edge of the picture, with a margin for balls that lie on it.
    const EDGE: f32 = 1.15;
    let is_seen = |(center, radius): (&carom::DVec3, &f64)| {
        let place = camera.place(*center, aspect);
        place.is_some_and(|place| place.abs().max_element() < EDGE)
            || center.distance(camera.position) < 2.0 * radius
    };
    let spheres = &view.spheres;
    !spheres.ids.is_empty() && !spheres.positions.iter().zip(&spheres.radii).any(is_seen)
}

/// Shows the hint that helps now, at the lower edge of the picture. Returns the actions of its
/// buttons.
pub(super) fn show(
    ui: &mut Ui,
    rect: Rect,
    view: &View,
    told: HintState,
    camera: &Camera,
    commands: &mut Vec<Command>,
) -> Vec<Action> {
    let mut actions = Vec::new();
    let HintState { way, restarted, seconds_at_work } = told;
    let aspect = f64::from(rect.width() / rect.height());
    let is_at_start = view.frame == 0 && !view.playback.playing && view.playback.error.is_none();
    let mut button = |ui: &mut Ui, text: &str, action: Action| {
        if ui.button(text).on_hover_text(action.hint()).clicked() {
            actions.push(action);
        }
    };
    if seconds_at_work > LONG && view.seeking.is_none() && view.playback.playing {
        ui.ctx().request_repaint_after_secs(0.1);
        card(ui, rect, |ui| {
            let text = format!("Computing this frame: {seconds_at_work:.0} s");
            ui.add_sized([WAY_WIDTH, ui.spacing().interact_size.y], Label::new(text));
            if ui.button("Stop").on_hover_text("Pause before this frame").clicked() {
                commands.push(Command::Pause);
            }
        });
    } else if view.seeking.is_some() {
        let Some(text) = way.and_then(|way| way.text(view)) else { return actions };
        card(ui, rect, |ui| {
            // A fixed width, so that the button does not move with the text.
            ui.add_sized([WAY_WIDTH, ui.spacing().interact_size.y], Label::new(text).truncate());
            if ui.button("Stop here").clicked() {
                commands.push(Command::StopSeeking);
            }
        });
    } else if let Some(Restarted { with_values, at }) = restarted
        && ui.input(|input| input.time) - at < TOLD
        && !view.edits.is_empty()
    {
        ui.ctx().request_repaint_after_secs(1.0);
        card(ui, rect, |ui| {
            if with_values {
                ui.label("It begins with the values that were set.");
                button(ui, "Undo", Action::Undo);
            } else {
                ui.label("Edits will come again, at the marks of the time line.");
                button(ui, "Begin with their values", Action::RestartWithValues);
            }
            if !view.playback.playing {
                button(ui, "▶ Play", Action::PlayOrPause);
            }
        });
    } else if is_at_start && is_compact(ui) {
        actions.extend(large_play_button(ui, rect));
    } else if all_have_left(view, camera, aspect) {
        card(ui, rect, |ui| {
            ui.label("All balls have left the picture.");
            button(ui, "Restart", Action::Restart);
            button(ui, "Fit", Action::Fit);
        });
    }
    actions
}

/// Shows the large button that plays the scene, where the transport has no large one.
fn large_play_button(ui: &Ui, rect: Rect) -> Option<Action> {
    let shown = area(rect).show(ui.ctx(), |ui| {
        let selection = ui.visuals().selection;
        let text = RichText::new("▶  Play").size(22.0).color(selection.stroke.color);
        let large = Button::new(text).fill(selection.bg_fill).corner_radius(24);
        let response = ui.add(large.min_size(Vec2::new(150.0, 48.0)));
        response.widget_info(|| WidgetInfo::labeled(Role::Button, true, "Play the scene"));
        response.clicked()
    });
    shown.inner.then_some(Action::PlayOrPause)
}

fn area(rect: Rect) -> Area {
    let place = rect.center_bottom() - Vec2::new(0.0, 18.0);
    Area::new(Id::unique("hints")).pivot(Align2::CENTER_BOTTOM).fixed_pos(place)
}

fn card(ui: &Ui, rect: Rect, content: impl FnOnce(&mut Ui)) {
    area(rect).show(ui.ctx(), |ui| {
        Frame::popup(ui.style()).show(ui, |ui| ui.horizontal(content));
    });
}
