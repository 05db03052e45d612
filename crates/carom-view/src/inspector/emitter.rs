//! Sources of balls.

use carom::{DQuat, DVec3, Emitter, Mass, Sphere};
use carom_scene::scene;
use carom_session::{Command, Edit, View};
use egui::{DragValue, Ui};

use super::value::{Field, name, number, number_at_last, vector};

pub(super) fn show(ui: &mut Ui, view: &View, commands: &mut Vec<Command>) {
    for (id, described) in &view.setup.emitters {
        ui.push_id(("emitter", *id), |ui| {
            if !described.name.is_empty() {
                ui.strong(&described.name);
            }
            let before = emitter(described);
            let mut after = before;
            // With another period it starts anew, and emits at once.
            number_at_last(ui, Field::positive("period", "s"), &mut after.period);
            most(ui, &mut after.max_spheres);
            let mut velocity = after.sphere.velocity.to_array();
            vector(ui, Field::any("velocity", "m/s"), &mut velocity);
            after.sphere.velocity = DVec3::from_array(velocity);
            number(ui, Field::positive("radius", "m"), &mut after.sphere.radius);
            let mut mass = after.sphere.kilograms();
            if number(ui, Field::positive("mass", "kg"), &mut mass) {
                after.sphere.mass = Mass::Kilograms(mass);
            }
            number(ui, Field::restitution(), &mut after.sphere.restitution);
            if after != before {
                commands.push(Command::Edit(Edit::Emitter(*id, Box::new(after))));
            }
        });
    }
}

/// How many of its balls live at a time.
fn most(ui: &mut Ui, max_spheres: &mut Option<u32>) {
    ui.horizontal(|ui| {
        name(ui, "at most");
        let mut is_limited = max_spheres.is_some();
        if ui.checkbox(&mut is_limited, "limited").changed() {
            *max_spheres = is_limited.then_some(25);
        }
        match max_spheres {
            Some(most) => ui.add(DragValue::new(most).range(1..=u32::MAX).suffix(" balls")),
            None => ui.weak("any number"),
        };
    });
}

/// An emitter as the physics knows it, from its description.
fn emitter(described: &scene::Emitter) -> Emitter {
    let sphere = &described.sphere;
    let radius = sphere.radius.or(sphere.diameter.map(|it| 0.5 * it)).unwrap_or_default();
    let mass = match (sphere.mass, sphere.density) {
        (Some(mass), _) => Mass::Kilograms(mass),
        (None, Some(density)) => Mass::Density(density),
        (None, None) => Mass::Kilograms(1.0),
    };
    let emitted = Sphere::new(DVec3::from_array(sphere.position), radius)
        .with_velocity(DVec3::from_array(sphere.velocity))
        .with_mass(mass)
        .with_restitution(sphere.restitution);
    Emitter::new(emitted, described.period)
        .with_position(DVec3::from_array(described.position))
        .with_rotation(DQuat::from_array(described.rotation))
        .with_max_spheres(described.max_spheres)
}
