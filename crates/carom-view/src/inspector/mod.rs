//! The inspector: values that can be read and changed while a scene runs.

mod ball;
mod collider;
mod emitter;
mod force;
mod friction;
mod parameters;
pub mod simulation;
mod spring;
mod surface;
mod value;

use carom::ColliderId;
use carom_scene::Parameter;
use carom_session::{Command, View};
use egui::{CollapsingHeader, ScrollArea, Ui};

use crate::layout::press_word;

pub use ball::Throw;
pub use value::significant;

/// Indent of the rows of a group, in points.
const INDENT: f32 = 13.0;

/// Shows the panel beside the picture, with the picked surface if there is one. Returns a parameter of
/// the scene file if its value was changed.
pub fn show(
    ui: &mut Ui,
    view: &View,
    parameters: &[Parameter],
    throw: &mut Throw,
    picked: &mut Option<ColliderId>,
    commands: &mut Vec<Command>,
) -> Option<Parameter> {
    let mut changed = None;
    ui.spacing_mut().indent = INDENT;
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        if !parameters.is_empty() {
            section(ui, "Parameters", true, |ui| changed = parameters::show(ui, parameters));
        }
        match view.picked {
            Some(id) => {
                // The number stands in the group, so that another ball keeps it open.
                section(ui, "Ball", true, |ui| ball::show(ui, view, id, commands));
            }
            None => {
                ui.weak(format!("{} a ball to see and change it.", press_word(ui)));
            }
        }
        if picked.is_some() {
            section(ui, "Surface", true, |ui| surface::show(ui, view, picked, commands));
        }
        if !view.setup.colliders.is_empty() {
            section(ui, "Surfaces", true, |ui| collider::show(ui, view, commands));
        }
        section(ui, "Forces", true, |ui| force::show(ui, view, commands));
        if !view.springs.is_empty() || view.picked.is_some() {
            section(ui, "Springs", true, |ui| spring::show(ui, view, commands));
        }
        if !view.setup.emitters.is_empty() {
            section(ui, "Emitters", true, |ui| emitter::show(ui, view, commands));
        }
        section(ui, "Simulation", true, |ui| simulation::show(ui, view, commands));
        section(ui, "Throw", false, |ui| ball::show_throw(ui, view, throw));
        section(ui, "State", false, |ui| state(ui, view));
    });
    changed
}

fn section(ui: &mut Ui, title: &str, open: bool, contents: impl FnOnce(&mut Ui)) {
    let header = CollapsingHeader::new(egui::RichText::new(title).strong()).id_salt(title);
    header.default_open(open).show(ui, contents);
}

/// Shows numbers about the state.
fn state(ui: &mut Ui, view: &View) {
    ui.label(format!("{} balls, {} impacts", view.spheres.ids.len(), view.now.impacts));
    ui.label(format!("energy {:.9e} J", view.now.total_energy()));
    if view.now.stepped > 0 {
        ui.label(format!("{} balls are stepped, not exact", view.now.stepped)).on_hover_text(
            "Their contacts would take too long one by one. Simulation, more settings, stepped \
             zones: never.",
        );
    }
}
