//! The picked ball, and the balls to be thrown.

use carom::DVec3;
use carom_session::{Command, Edit, SphereChange, View};
use egui::Ui;

use super::friction;
use super::value::{Field, number, vector};
use crate::layout::press_word;

/// Properties of a ball that the user throws into the scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Throw {
    /// \[m\]
    pub radius: f64,
    /// \[kg\]
    pub mass: f64,
    /// \[m/s\]
    pub speed: f64,
    /// Coefficient of restitution.
    pub restitution: f64,
}

impl Default for Throw {
    fn default() -> Self {
        Self { radius: 0.5, mass: 1.0, speed: 10.0, restitution: 1.0 }
    }
}

pub(super) fn show(ui: &mut Ui, view: &View, commands: &mut Vec<Command>) {
    let Some(id) = view.picked else {
        ui.weak(format!("{} on a ball to pick it.", press_word(ui)));
        return;
    };
    let Some(i) = view.spheres.index_of(id) else {
        ui.weak(format!("Ball {id} has left the scene."));
        return;
    };
    ui.strong(format!("Ball {id}"));
    let spheres = &view.spheres;
    let mut change = SphereChange::default();
    let vectors = [
        ("position", "m", spheres.positions[i], &mut change.position),
        ("velocity", "m/s", spheres.velocities[i], &mut change.velocity),
        ("spin", "rad/s", spheres.angular_velocity(i), &mut change.angular_velocity),
    ];
    for (name, unit, now, changed) in vectors {
        let mut value = now.to_array();
        if vector(ui, Field::any(name, unit), &mut value) {
            *changed = Some(DVec3::from_array(value));
        }
    }
    let numbers = [
        (Field::positive("radius", "m"), spheres.radii[i], &mut change.radius),
        (Field::positive("mass", "kg"), spheres.masses[i], &mut change.mass),
        (Field::restitution(), spheres.restitutions[i], &mut change.restitution),
    ];
    for (field, now, changed) in numbers {
        let mut value = now;
        if number(ui, field, &mut value) {
            *changed = Some(value);
        }
    }
    if friction::acts(view) {
        let mut said = spheres.friction(i);
        if friction::show(ui, &format!("Friction of ball {id}"), &mut said) {
            change.friction = Some(said);
        }
    }
    if change != SphereChange::default() {
        commands.push(Command::Edit(Edit::Sphere(id, Box::new(change))));
    }
    ui.horizontal(|ui| {
        if ui.small_button("Stop it").clicked() {
            let velocity = Some(DVec3::ZERO);
            let stop = SphereChange { velocity, ..Default::default() };
            commands.push(Command::Edit(Edit::Sphere(id, Box::new(stop))));
        }
        if ui.small_button("Remove it").clicked() {
            commands.push(Command::Edit(Edit::RemoveSphere(id)));
        }
        if ui.small_button("Let go").clicked() {
            commands.push(Command::Pick(None));
        }
    });
}

pub(super) fn show_throw(ui: &mut Ui, throw: &mut Throw) {
    ui.weak("Ctrl + click into the picture throws a ball that way.");
    number(ui, Field::positive("radius", "m"), &mut throw.radius);
    number(ui, Field::positive("mass", "kg"), &mut throw.mass);
    number(ui, Field::not_negative("speed", "m/s"), &mut throw.speed);
    number(ui, Field::restitution(), &mut throw.restitution);
}
