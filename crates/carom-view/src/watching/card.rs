//! The card of a scene: what it shows, and what to try in it.

use std::sync::Arc;

use carom_scene::scene::{Scene, Try};
use carom_scene::{SceneError, Tried};
use carom_session::{Command, Edit, Setup, View};
use egui::{Align, Area, Frame, Id, Label, Layout, Rect, Response, RichText, Role, Ui, Vec2};
use egui::{Slider, WidgetInfo};

use crate::inspector::significant;
use crate::layout::{has_sheets, is_low};

/// Width of the card without its frame, in points.
const WIDTH: f32 = 264.0;

/// Distance from the corner of the picture, in points.
const CORNER: Vec2 = Vec2::new(10.0, 10.0);

/// The card of the watched scene.
#[derive(Default)]
pub(super) struct Card {
    /// Whether it is open; by default where the window is large.
    is_open: Option<bool>,
    /// What was read last.
    read: Option<Read>,
    /// A slider that is being dragged, and its number, where the scene has to begin again with it.
    held: Option<(usize, f64)>,
}

/// The numbers of the suggestions of a scene, as edited.
struct Read {
    scene: Arc<Scene>,
    setup: Arc<Setup>,
    numbers: Vec<Option<Tried>>,
}

impl Card {
    /// Shows the card. Returns a suggestion with its new number.
    pub fn show(&mut self, ui: &Ui, picture: Rect, view: &View) -> Option<(usize, f64)> {
        let is_large = !has_sheets(ui) && !is_low(ui);
        let is_open = self.is_open.unwrap_or(is_large);
        let numbers = self.numbers(view);
        let area = Area::new(Id::unique("card")).fixed_pos(picture.min + CORNER);
        let shown = area.show(ui.ctx(), |ui| {
            if !is_open {
                let button = ui.button("Try this").on_hover_text("What to try in this scene");
                if button.clicked() {
                    self.is_open = Some(true);
                }
                return None;
            }
            let width = WIDTH.min(picture.width() - 2.0 * CORNER.x - 16.0);
            Frame::popup(ui.style())
                .show(ui, |ui| {
                    ui.set_width(width);
                    self.head(ui, &view.scene);
                    let tries = view.scene.tries.iter().zip(numbers).enumerate();
                    tries.fold(None, |changed, (index, (suggestion, number))| {
                        let new = number.and_then(|it| self.suggestion(ui, index, suggestion, it));
                        new.map(|number| (index, number)).or(changed)
                    })
                })
                .inner
        });
        shown.inner
    }

    fn head(&mut self, ui: &mut Ui, scene: &Scene) {
        let title = if scene.title.is_empty() { &scene.name } else { &scene.title };
        ui.horizontal(|ui| {
            ui.label(RichText::new(title).strong().size(15.0));
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                let close = ui.small_button("✖");
                close.widget_info(|| WidgetInfo::labeled(Role::Button, true, "Close the card"));
                if close.clicked() {
                    self.is_open = Some(false);
                }
            });
        });
        let sentence = scene.description.split_inclusive(". ").next().unwrap_or_default();
        ui.add(Label::new(sentence.trim_end()).wrap());
        ui.separator();
        ui.label(RichText::new("Try this:").strong());
    }

    /// Shows a suggestion with its slider. Returns its new number.
    fn suggestion(&mut self, ui: &mut Ui, index: usize, it: &Try, now: Tried) -> Option<f64> {
        ui.add_space(2.0);
        ui.add(Label::new(&it.text).wrap());
        let mut number = self.held.filter(|held| held.0 == index).map_or(now.value, |held| held.1);
        let [low, high] = it.range;
        ui.spacing_mut().slider_width = ui.available_width() - 58.0;
        // An edit may have left the range.
        let slider = Slider::new(&mut number, low.min(now.value)..=high.max(now.value));
        let slider = slider.step_by(if now.is_whole { 1.0 } else { 0.0 });
        let response = ui.add(slider.custom_formatter(|number, _| significant(number)));
        response.widget_info(|| WidgetInfo::slider(true, number, &it.text));
        let response = response.on_hover_text(if is_live(&it.path) {
            "It changes at once."
        } else {
            "The scene begins again with it."
        });
        self.changed(index, &response, number, is_live(&it.path))
    }

    /// Returns a number that was set. A slider that begins the scene again does so once, at the end.
    fn changed(
        &mut self,
        index: usize,
        response: &Response,
        number: f64,
        live: bool,
    ) -> Option<f64> {
        if live {
            return response.changed().then_some(number);
        }
        if response.dragged() {
            self.held = Some((index, number));
            return None;
        }
        let held = self.held.take_if(|held| held.0 == index);
        (response.changed() || held.is_some()).then_some(number)
    }

    /// Returns the numbers of the suggestions of a scene as edited.
    fn numbers(&mut self, view: &View) -> Vec<Option<Tried>> {
        if let Some(Read { scene, setup, numbers }) = &self.read
            && Arc::ptr_eq(scene, &view.scene)
            && Arc::ptr_eq(setup, &view.setup)
        {
            return numbers.clone();
        }
        let edited = edited(view);
        let numbers: Vec<_> = edited.tries.iter().map(|it| it.number_in(&edited)).collect();
        let (scene, setup) = (view.scene.clone(), view.setup.clone());
        self.read = Some(Read { scene, setup, numbers: numbers.clone() });
        numbers
    }
}

/// Returns the commands that set the number of a suggestion.
pub(super) fn commands(view: &View, index: usize, number: f64) -> Result<Vec<Command>, SceneError> {
    let suggestion = &view.scene.tries[index];
    let changed = suggestion.applied_to(&edited(view), number)?;
    if !is_live(&suggestion.path) {
        return Ok(vec![Command::Open(Box::new(changed))]);
    }
    let setup = &view.setup;
    let simulation = (changed.simulation != setup.simulation)
        .then(|| Edit::Simulation(Box::new(changed.simulation.clone())));
    let forces = setup.forces.iter().zip(&changed.forces).filter(|((_, old), new)| old != *new);
    let forces = forces.map(|((id, _), new)| Edit::Force(*id, new.clone()));
    let colliders = setup.colliders.iter().zip(&changed.colliders);
    let colliders = colliders.filter(|((_, old), new)| old.restitution != new.restitution);
    let colliders = colliders.map(|((id, _), new)| Edit::ColliderRestitution(*id, new.restitution));
    Ok(simulation.into_iter().chain(forces).chain(colliders).map(Command::Edit).collect())
}

/// Returns whether the number at a path changes while the scene runs.
fn is_live(path: &str) -> bool {
    let is_collider = path.starts_with("colliders") && path.ends_with(".restitution");
    is_collider || path.starts_with("forces") || path.starts_with("simulation")
}

/// Returns the scene as opened, with the edits of what is no sphere.
fn edited(view: &View) -> Scene {
    let opened = &*view.scene;
    let now = view.setup.scene(opened);
    // Those of generators come after the single ones.
    let colliders = now.colliders.into_iter().take(opened.colliders.len()).collect();
    Scene {
        colliders,
        spheres: opened.spheres.clone(),
        generators: opened.generators.clone(),
        springs: opened.springs.clone(),
        ..now
    }
}
