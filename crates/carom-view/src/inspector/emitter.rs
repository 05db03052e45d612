//! Emitters of balls.

use carom::{DVec3, Mass};
use carom_scene::scene::Rule;
use carom_session::{Command, Edit, View};
use egui::{DragValue, Role, Ui, WidgetInfo};

use super::friction;
use super::value::{Field, name, number, number_at_last, tick, vector};

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
            let period = Field::positive("One ball every (period)", "s");
            let period = period.hint("Time between two balls");
            number_at_last(ui, period, &mut after.period);
            limit(ui, "At most at a time", 25, &mut after.max_spheres);
            limit(ui, "At most in all", 60, &mut after.count);
            room(ui, &mut after.needs_room, view.setup.simulation.rule == Rule::Contact);
            let mut velocity = after.sphere.velocity.to_array();
            vector(ui, Field::any("Velocity", "m/s").hint("Velocity of new balls"), &mut velocity);
            after.sphere.velocity = DVec3::from_array(velocity);
            let radius = Field::positive("Radius", "m").hint("Radius of new balls");
            number(ui, radius, &mut after.sphere.radius);
            let mut mass = after.sphere.kilograms();
            if number(ui, Field::positive("Mass", "kg").hint("Mass of new balls"), &mut mass) {
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
    let mut is_needed = needs_room.unwrap_or(is_contact);
    let hint = "A ball that would overlap another one is left out";
    if tick(ui, "Only where there is room", hint, &mut is_needed) {
        *needs_room = Some(is_needed);
    }
}

/// Shows a limit on balls, at a time or in all; `usual` is the first value of a new limit.
fn limit(ui: &mut Ui, what: &str, usual: u32, limit: &mut Option<u32>) {
    let hint = "Largest number of balls of this emitter; without a tick any number";
    ui.horizontal(|ui| {
        name(ui, what, hint);
        let mut is_limited = limit.is_some();
        let tick = ui.checkbox(&mut is_limited, "").on_hover_text(hint);
        let text = format!("{what} is limited");
        tick.widget_info(|| WidgetInfo::selected(Role::CheckBox, true, is_limited, &text));
        if tick.changed() {
            *limit = is_limited.then_some(usual);
        }
        match limit {
            Some(most) => {
                let drag = DragValue::new(most).range(1..=u32::MAX).suffix(" balls");
                let response = ui.add(drag).on_hover_text(hint);
                response.widget_info(|| WidgetInfo {
                    label: Some(format!("{what}, balls")),
                    ..WidgetInfo::drag_value(true, f64::from(*most))
                });
            }
            None => {
                ui.weak("any number");
            }
        }
    });
}
