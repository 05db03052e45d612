//! The picked ball, and the balls to be thrown.

use carom::{DVec3, SphereId};
use carom_session::{Command, Edit, SphereChange, View};
use egui::Ui;

use super::friction;
use super::value::{Field, number, vector};

/// Properties of a ball that the user throws into the scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Throw {
    /// Radius \[m\].
    pub radius: f64,
    /// Mass \[kg\].
    pub mass: f64,
    /// Speed \[m/s\].
    pub speed: f64,
    /// Coefficient of restitution.
    pub restitution: f64,
}

impl Default for Throw {
    fn default() -> Self {
        Self::with(0.5, 1.0)
    }
}

impl Throw {
    /// Speed of a thrown ball in radii per second.
    const SPEED: f64 = 20.0;

    fn with(radius: f64, mass: f64) -> Self {
        Self { radius, mass, speed: Self::SPEED * radius, restitution: 1.0 }
    }

    /// Returns a ball like those of a scene: with their median radius and mass. Without balls, that
    /// is the ball of the first emitter.
    pub fn like_those_of(view: &View) -> Self {
        let spheres = &view.spheres;
        if let Some((radius, mass)) = median(&spheres.radii).zip(median(&spheres.masses)) {
            return Self::with(radius, mass);
        }
        let emitted = view.setup.emitters.iter().find_map(|(_, it)| it.emitter().ok());
        emitted.map_or_else(Self::default, |it| Self::with(it.sphere.radius, it.sphere.kilograms()))
    }
}

/// Returns the middle one of the values by size, the upper of two; `None` without values.
fn median(values: &[f64]) -> Option<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied()
}

const POSITION: Field = Field {
    name: "Position",
    unit: "m",
    hint: "Centre of the ball; y is up",
    min: f64::NEG_INFINITY,
    max: f64::INFINITY,
    is_whole: false,
};
const VELOCITY: Field =
    Field { name: "Velocity", unit: "m/s", hint: "Speed along each axis", ..POSITION };
const SPIN: Field = Field {
    name: "Spin (angular velocity)",
    unit: "rad/s",
    hint: "Speed of rotation about each axis",
    ..POSITION
};

fn radius() -> Field<'static> {
    Field::positive("Radius", "m").hint("Radius of the ball")
}

fn mass() -> Field<'static> {
    Field::positive("Mass", "kg").hint("Mass of the ball")
}

pub(super) fn show(ui: &mut Ui, view: &View, id: SphereId, commands: &mut Vec<Command>) {
    let Some(i) = view.spheres.index_of(id) else {
        ui.weak(format!("Ball {id} has left the scene."));
        return;
    };
    ui.strong(format!("Ball {id}"));
    let spheres = &view.spheres;
    let mut change = SphereChange::default();
    let vectors = [
        (POSITION, spheres.positions[i], &mut change.position),
        (VELOCITY, spheres.velocities[i], &mut change.velocity),
        (SPIN, spheres.angular_velocity(i), &mut change.angular_velocity),
    ];
    for (field, now, changed) in vectors {
        let mut value = now.to_array();
        if vector(ui, field, &mut value) {
            *changed = Some(DVec3::from_array(value));
        }
    }
    let numbers = [
        (radius(), spheres.radii[i], &mut change.radius),
        (mass(), spheres.masses[i], &mut change.mass),
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

pub(super) fn show_throw(ui: &mut Ui, view: &View, throw: &mut Throw) {
    ui.weak("Ctrl + click into the picture throws a ball that way; B throws one to its middle.");
    number(ui, radius(), &mut throw.radius);
    number(ui, mass(), &mut throw.mass);
    number(ui, Field::not_negative("Speed", "m/s").hint("Speed of the throw"), &mut throw.speed);
    number(ui, Field::restitution(), &mut throw.restitution);
    if ui.small_button("Like the others").clicked() {
        *throw = Throw::like_those_of(view);
    }
}
