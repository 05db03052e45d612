//! Emitters of balls.

use carom::{DVec3, Mass};
use carom_scene::scene::Rule;
use carom_session::{Command, Edit, View};
use egui::{DragValue, Ui};

use super::friction;
use super::value::{Field, name, number, number_at_last, vector};

pub(super) fn show(ui: &mut Ui, view: &View, commands: &mut Vec<Command>) {
    for (id, described) in &view.setup.emitters {
        ui.push_id(("emitter", *id), |ui| {
            if !described.name.is_empty() {
                ui.strong(&described.name);
            }
            // The world has no invalid emitters.
            let Ok(before) = described.emitter() else { return };
            let mut after = before;
            // A new period restarts the emitter, which emits at once.
            number_at_last(ui, Field::positive("period", "s"), &mut after.period);
            limit(ui, "at most", 25, &mut after.max_spheres);
            limit(ui, "in all", 60, &mut after.count);
            room(ui, &mut after.needs_room, view.setup.simulation.rule == Rule::Contact);
            let mut velocity = after.sphere.velocity.to_array();
            vector(ui, Field::any("velocity", "m/s"), &mut velocity);
            after.sphere.velocity = DVec3::from_array(velocity);
            number(ui, Field::positive("radius", "m"), &mut after.sphere.radius);
            let mut mass = after.sphere.kilograms();
            if number(ui, Field::positive("mass", "kg"), &mut mass) {
                after.sphere.mass = Mass::Kilograms(mass);
            }
            number(ui, Field::restitution(), &mut after.sphere.restitution);
            if friction::acts(view) {
                friction::show(ui, "Friction of its balls", &mut after.sphere.friction);
            }
            if after != before {
                commands.push(Command::Edit(Edit::Emitter(*id, Box::new(after))));
            }
        });
    }
}

/// Shows whether the emitter leaves out balls that would overlap others. The default is yes under
/// the rule `contact`.
fn room(ui: &mut Ui, needs_room: &mut Option<bool>, is_contact: bool) {
    ui.horizontal(|ui| {
        name(ui, "needs room");
        let mut is_needed = needs_room.unwrap_or(is_contact);
        let hint = "A ball that would overlap another one is left out";
        if ui.checkbox(&mut is_needed, "").on_hover_text(hint).changed() {
            *needs_room = Some(is_needed);
        }
    });
}

/// Shows a limit on balls, at a time or in all; `usual` is the first value of a new limit.
fn limit(ui: &mut Ui, what: &str, usual: u32, limit: &mut Option<u32>) {
    ui.horizontal(|ui| {
        name(ui, what);
        let mut is_limited = limit.is_some();
        if ui.checkbox(&mut is_limited, "limited").changed() {
            *limit = is_limited.then_some(usual);
        }
        match limit {
            Some(most) => ui.add(DragValue::new(most).range(1..=u32::MAX).suffix(" balls")),
            None => ui.weak("any number"),
        };
    });
}
