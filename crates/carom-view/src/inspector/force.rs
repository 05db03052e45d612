//! Forces on every ball.

use carom_scene::scene::Force;
use carom_session::{Command, Edit, View};
use egui::Ui;

use super::value::{Field, number, vector};

pub(super) fn show(ui: &mut Ui, view: &View, commands: &mut Vec<Command>) {
    for (id, force) in &view.setup.forces {
        ui.push_id(("force", *id), |ui| {
            let mut changed = force.clone();
            let is_changed = match &mut changed {
                Force::Constant { force } => vector(ui, Field::any("force", "N"), force),
                Force::Gravity { acceleration } => {
                    vector(ui, Field::any("gravity", "m/s²"), acceleration)
                }
                Force::ViscousDrag { coefficient } => {
                    number(ui, Field::not_negative("drag", "kg/s"), coefficient)
                }
            };
            if is_changed {
                commands.push(Command::Edit(Edit::Force(*id, changed)));
            }
            if ui.small_button("Remove").clicked() {
                commands.push(Command::Edit(Edit::RemoveForce(*id)));
            }
        });
    }
    ui.horizontal(|ui| {
        let mut add = |ui: &mut Ui, text: &str, force: Force| {
            if ui.small_button(text).clicked() {
                commands.push(Command::Edit(Edit::AddForce(force)));
            }
        };
        add(ui, "+ gravity", Force::Gravity { acceleration: [0.0, -9.81, 0.0] });
        add(ui, "+ drag", Force::ViscousDrag { coefficient: 0.1 });
        add(ui, "+ force", Force::Constant { force: [0.0; 3] });
    });
}
