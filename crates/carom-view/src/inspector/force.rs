//! Forces on the balls.

use carom_scene::scene::Force;
use carom_session::{Command, Edit, View};
use egui::{Align, Layout, Role, Ui, WidgetInfo};

use super::value::{Field, number, vector};

pub(super) fn show(ui: &mut Ui, view: &View, commands: &mut Vec<Command>) {
    for (id, force) in &view.setup.forces {
        ui.push_id(("force", *id), |ui| {
            let mut changed = force.clone();
            ui.horizontal(|ui| {
                ui.strong(title(force));
                ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                    let button = ui.small_button("Remove");
                    let text = format!("Remove {}", title(force));
                    button.widget_info(|| WidgetInfo::labeled(Role::Button, true, &text));
                    if button.clicked() {
                        commands.push(Command::Edit(Edit::RemoveForce(*id)));
                    }
                });
            });
            if rows(ui, &mut changed) {
                commands.push(Command::Edit(Edit::Force(*id, changed)));
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
    ui.menu_button("+ another", |ui| {
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

/// Returns the name of a force.
fn title(force: &Force) -> &'static str {
    match force {
        Force::Constant { .. } => "Constant force",
        Force::Gravity { .. } => "Gravity",
        Force::ViscousDrag { .. } => "Drag (viscous)",
        Force::PointAttractor { .. } => "Point attractor",
        Force::MutualGravity { .. } => "Gravity between balls",
        Force::Wind { .. } => "Wind",
        Force::Vortex { .. } => "Vortex",
        Force::QuadraticDrag { .. } => "Drag (quadratic)",
        Force::Buoyancy { .. } => "Buoyancy",
    }
}

const SOFTENING: Field = Field {
    name: "Softening",
    unit: "m",
    hint: "Distance below which the pull stops growing",
    min: 0.0,
    max: f64::INFINITY,
    is_whole: false,
};
const DRAG: Field = Field {
    name: "Drag coefficient",
    unit: "kg/s",
    hint: "Force against the motion, per speed relative to the medium",
    ..SOFTENING
};

/// Shows the values of a force. Returns whether one was changed.
fn rows(ui: &mut Ui, force: &mut Force) -> bool {
    let any = |name, unit, hint| Field::any(name, unit).hint(hint);
    let not_negative = |name, unit, hint| Field::not_negative(name, unit).hint(hint);
    match force {
        Force::Constant { force } => {
            vector(ui, any("Force", "N", "The same force on every ball"), force)
        }
        Force::Gravity { acceleration } => {
            vector(ui, any("Acceleration", "m/s²", "Acceleration of free fall"), acceleration)
        }
        Force::ViscousDrag { coefficient } => number(ui, DRAG, coefficient),
        Force::PointAttractor { position, gravitational_parameter, softening } => {
            vector(ui, any("Position", "m", "Place of the attractor"), position)
                | number(
                    ui,
                    any("Strength (G M)", "m³/s²", "Gravitational parameter"),
                    gravitational_parameter,
                )
                | number(ui, SOFTENING, softening)
        }
        Force::MutualGravity { constant, softening, opening_angle } => {
            let angle = not_negative("Opening angle", "", "Accuracy for far groups; 0: all pairs");
            let constant_of = any("Strength (G)", "m³/(kg s²)", "Gravitational constant");
            number(ui, constant_of, constant)
                | number(ui, SOFTENING, softening)
                | number(ui, Field { max: 1.0, ..angle }, opening_angle)
        }
        Force::Wind { velocity, coefficient } => {
            vector(ui, any("Velocity", "m/s", "Velocity of the air"), velocity)
                | number(ui, DRAG, coefficient)
        }
        Force::Vortex { position, axis, circulation, core_radius, coefficient } => {
            let core = Field::positive("Core radius", "m").hint("Within it, air turns as a whole");
            vector(ui, any("Position", "m", "A point of the axis"), position)
                | vector(ui, any("Axis", "", "Direction about which the air turns"), axis)
                | number(
                    ui,
                    any("Circulation", "m²/s", "Speed of the air times the way round"),
                    circulation,
                )
                | number(ui, core, core_radius)
                | number(ui, DRAG, coefficient)
        }
        Force::QuadraticDrag { density, drag_coefficient, viscosity, wind } => {
            number(ui, not_negative("Density", "kg/m³", "Density of the medium"), density)
                | number(
                    ui,
                    not_negative("Drag coefficient", "", "0.44 for a ball in fast flow"),
                    drag_coefficient,
                )
                | number(
                    ui,
                    not_negative("Viscosity", "Pa s", "Viscosity of the medium"),
                    viscosity,
                )
                | vector(ui, any("Wind", "m/s", "Velocity of the medium"), wind)
        }
        Force::Buoyancy { density, surface_height, gravity } => {
            number(ui, not_negative("Density", "kg/m³", "Density of the fluid"), density)
                | number(ui, any("Surface at", "m", "Height of the surface"), surface_height)
                | vector(ui, any("Gravity", "m/s²", "Acceleration of free fall"), gravity)
        }
    }
}
