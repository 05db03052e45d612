//! Forces on the balls.

use carom_scene::scene::Force;
use carom_session::{Command, Edit, View};
use egui::Ui;

use super::value::{Field, number, vector};

pub(super) fn show(ui: &mut Ui, view: &View, commands: &mut Vec<Command>) {
    for (id, force) in &view.setup.forces {
        ui.push_id(("force", *id), |ui| {
            let mut changed = force.clone();
            if rows(ui, &mut changed) {
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
    ui.menu_button("+ other force", |ui| {
        for (text, force) in others() {
            if ui.button(text).clicked() {
                commands.push(Command::Edit(Edit::AddForce(force)));
                ui.close();
            }
        }
    });
}

/// Returns less common forces with their initial values.
fn others() -> [(&'static str, Force); 6] {
    let (position, axis) = ([0.0; 3], [0.0, 1.0, 0.0]);
    [
        (
            "Point attractor",
            Force::PointAttractor { position, gravitational_parameter: 1.0, softening: 0.1 },
        ),
        (
            "Gravity between balls",
            Force::MutualGravity { constant: 1.0, softening: 0.1, opening_angle: 0.5 },
        ),
        ("Wind", Force::Wind { velocity: [1.0, 0.0, 0.0], coefficient: 0.1 }),
        (
            "Vortex",
            Force::Vortex { position, axis, circulation: 5.0, core_radius: 1.0, coefficient: 0.1 },
        ),
        (
            "Quadratic drag",
            Force::QuadraticDrag {
                density: 1.2,
                drag_coefficient: 0.44,
                viscosity: 0.0,
                wind: [0.0; 3],
            },
        ),
        (
            "Buoyancy",
            Force::Buoyancy { density: 1000.0, surface_height: 0.0, gravity: [0.0, -9.81, 0.0] },
        ),
    ]
}

/// Shows the values of a force. Returns whether one was changed.
fn rows(ui: &mut Ui, force: &mut Force) -> bool {
    match force {
        Force::Constant { force } => vector(ui, Field::any("force", "N"), force),
        Force::Gravity { acceleration } => vector(ui, Field::any("gravity", "m/s²"), acceleration),
        Force::ViscousDrag { coefficient } => {
            number(ui, Field::not_negative("drag", "kg/s"), coefficient)
        }
        Force::PointAttractor { position, gravitational_parameter, softening } => {
            vector(ui, Field::any("attractor", "m"), position)
                | number(ui, Field::any("G M", "m³/s²"), gravitational_parameter)
                | number(ui, Field::not_negative("softening", "m"), softening)
        }
        Force::MutualGravity { constant, softening, opening_angle } => {
            let angle = Field { max: 1.0, ..Field::not_negative("opening angle", "") };
            number(ui, Field::any("G", "m³/(kg s²)"), constant)
                | number(ui, Field::not_negative("softening", "m"), softening)
                | number(ui, angle, opening_angle)
        }
        Force::Wind { velocity, coefficient } => {
            vector(ui, Field::any("wind", "m/s"), velocity)
                | number(ui, Field::not_negative("drag", "kg/s"), coefficient)
        }
        Force::Vortex { position, axis, circulation, core_radius, coefficient } => {
            vector(ui, Field::any("vortex", "m"), position)
                | vector(ui, Field::any("axis", ""), axis)
                | number(ui, Field::any("circulation", "m²/s"), circulation)
                | number(ui, Field::positive("core radius", "m"), core_radius)
                | number(ui, Field::not_negative("drag", "kg/s"), coefficient)
        }
        Force::QuadraticDrag { density, drag_coefficient, viscosity, wind } => {
            number(ui, Field::not_negative("medium", "kg/m³"), density)
                | number(ui, Field::not_negative("drag coefficient", ""), drag_coefficient)
                | number(ui, Field::not_negative("viscosity", "Pa s"), viscosity)
                | vector(ui, Field::any("wind", "m/s"), wind)
        }
        Force::Buoyancy { density, surface_height, gravity } => {
            number(ui, Field::not_negative("fluid", "kg/m³"), density)
                | number(ui, Field::any("surface at", "m"), surface_height)
                | vector(ui, Field::any("gravity", "m/s²"), gravity)
        }
    }
}
