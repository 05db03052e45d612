//! The picked surface.

use std::f64::consts::PI;

use carom::{ColliderId, DQuat, DVec3, Pose};
use carom_scene::scene::{Collider, Piece, Shape};
use carom_session::{Command, Edit, View};
use egui::Ui;
use glam::EulerRot;

use super::collider::motion_of;
use super::friction;
use super::value::{Field, number, significant, vector};

/// Shows what the surface is, with the values that can be changed.
pub(super) fn show(
    ui: &mut Ui,
    view: &View,
    picked: &mut Option<ColliderId>,
    commands: &mut Vec<Command>,
) {
    let found = view.setup.colliders.iter().position(|(id, _)| Some(*id) == *picked);
    let Some(index) = found else { return };
    let ((id, collider), pose) = (&view.setup.colliders[index], view.poses[index]);
    let name =
        if collider.name.is_empty() { format!("surface {index}") } else { collider.name.clone() };
    ui.strong(name);
    for fact in facts(&collider.shape) {
        ui.label(fact);
    }
    if !collider.motion.is_empty() {
        ui.label(motion_of(collider));
    }
    if let Some(pose) = put(ui, *id, pose) {
        commands.push(Command::Edit(Edit::ColliderPose(*id, pose)));
    }
    if let Some(scale) = scaled(ui, &collider.shape) {
        commands.push(Command::Edit(Edit::ColliderScale(*id, scale)));
    }
    answer(ui, view, (*id, collider), commands);
    if ui.small_button("Let go").clicked() {
        *picked = None;
    }
}

/// Shows where the surface is. Returns its pose if it was changed.
fn put(ui: &mut Ui, id: ColliderId, pose: Pose) -> Option<Pose> {
    let place = Field::any("Position", "m").hint("Origin of the surface; y is up");
    let turn = Field::any("Rotation", "°").hint("Turned about x, then y, then z of its own");
    let mut position = pose.position.to_array();
    let is_moved = vector(ui, place, &mut position);
    // Angles are not unique; those that were set stay until something else turns the surface.
    let key = ui.scope_id().with(("turned", id));
    let set = ui.data(|data| data.get_temp::<([f64; 3], DQuat)>(key));
    let angles = set.filter(|(_, of)| *of == pose.rotation).map(|(angles, _)| angles);
    let mut degrees = angles.unwrap_or_else(|| degrees_of(pose.rotation));
    let is_turned = vector(ui, turn, &mut degrees);
    let rotation = if is_turned { turned_by(degrees) } else { pose.rotation };
    if is_turned {
        ui.data_mut(|data| data.insert_temp(key, (degrees, rotation)));
    }
    let position = DVec3::from_array(position);
    (is_moved || is_turned).then(|| Pose::at(position).rotated(rotation))
}

/// Shows the scale of a surface of triangles. Returns it if it was changed.
fn scaled(ui: &mut Ui, shape: &Shape) -> Option<f64> {
    let field = match shape {
        Shape::HeightField(_) => Field::positive("Length", "m").hint("Along x; all lengths follow"),
        Shape::Track(_) => Field::positive("Radius", "m").hint("Of the gutter; all lengths follow"),
        _ => Field::positive("Scale", "").hint("Factor of all coordinates"),
    };
    let mut scale = shape.scale()?;
    number(ui, field, &mut scale).then_some(scale)
}

/// Returns the angles \[°\] about the own axes x, y, z, one after the other.
fn degrees_of(rotation: DQuat) -> [f64; 3] {
    let (x, y, z) = rotation.normalize().to_euler(EulerRot::XYZ);
    // Zero without a sign.
    [x, y, z].map(|angle| 180.0 / PI * angle + 0.0)
}

fn turned_by(degrees: [f64; 3]) -> DQuat {
    let [x, y, z] = degrees.map(|it| it * PI / 180.0);
    DQuat::from_euler(EulerRot::XYZ, x, y, z)
}

/// Shows how spheres bounce off the surface.
fn answer(
    ui: &mut Ui,
    view: &View,
    (id, collider): (ColliderId, &Collider),
    commands: &mut Vec<Command>,
) {
    if collider.trigger {
        ui.label("deflects nothing");
        return;
    }
    let mut restitution = collider.restitution;
    if number(ui, Field::restitution(), &mut restitution) {
        commands.push(Command::Edit(Edit::ColliderRestitution(id, restitution)));
    }
    let mut said = collider.surface_friction();
    if friction::acts(view) && friction::show(ui, "Friction of the picked surface", &mut said) {
        commands.push(Command::Edit(Edit::ColliderFriction(id, said)));
    }
}

/// Returns what a shape is, in lines.
fn facts(shape: &Shape) -> Vec<String> {
    let mut facts = vec![kind(shape)];
    // The world has no surface that cannot be made.
    let Ok(carom::Shape::Mesh(mesh)) = shape.physical() else { return facts };
    let sides = match (mesh.is_closed(), mesh.is_one_sided()) {
        (true, _) => "closed",
        (false, true) => "open, met from the front",
        (false, false) => "open, met from both sides",
    };
    facts.push(format!("{} triangles, {sides}", mesh.triangles().len()));
    let [min, max] = mesh.bounds();
    let [x, y, z] = (max - min).to_array().map(significant);
    facts.push(format!("{x} m × {y} m × {z} m"));
    facts
}

/// Returns the kind of a shape with its sizes \[m\].
fn kind(shape: &Shape) -> String {
    let meters = |length: f64| format!("{} m", significant(length));
    let three = |size: &[f64; 3]| size.map(meters).join(" × ");
    match shape {
        Shape::Sphere { radius } => format!("sphere, radius {}", meters(*radius)),
        Shape::Rectangle { size_x, size_z } => {
            format!("rectangle, {} × {}", meters(*size_x), meters(*size_z))
        }
        Shape::HalfSpace => "half-space".to_owned(),
        Shape::Box { size } => format!("box, {}", three(size)),
        Shape::Container { size, .. } => format!("container, {}", three(size)),
        Shape::Mesh(mesh) => match &mesh.file {
            Some(file) => format!("mesh of {file}"),
            None => "mesh".to_owned(),
        },
        Shape::HeightField(field) => {
            let columns = field.heights.first().map_or(0, Vec::len);
            format!("height field, {columns} × {} heights", field.heights.len())
        }
        Shape::Track(track) => {
            let gaps = track.pieces.iter().filter(|it| matches!(it, Piece::Gap { .. })).count();
            let pieces = track.pieces.len() - gaps;
            let radius = meters(track.radius);
            format!("track, radius {radius}, pieces {pieces}, gaps {gaps}")
        }
        Shape::Cylinder { radius, height } => {
            format!("cylinder, radius {}, height {}", meters(*radius), meters(*height))
        }
        Shape::Cone { bottom_radius, top_radius, height } => {
            let [bottom, top, height] = [*bottom_radius, *top_radius, *height].map(meters);
            format!("cone, radii {bottom} and {top}, height {height}")
        }
        Shape::Capsule { radius, length } => {
            format!("capsule, radius {}, length {}", meters(*radius), meters(*length))
        }
        Shape::Disc { radius } => format!("disc, radius {}", meters(*radius)),
        Shape::Torus { ring_radius, tube_radius } => {
            format!("torus, radii {} and {}", meters(*ring_radius), meters(*tube_radius))
        }
        Shape::Pipe { radius, length, .. } => {
            format!("pipe, radius {}, length {}", meters(*radius), meters(*length))
        }
        Shape::Bowl { radius, opening_degrees } => {
            format!("bowl, radius {}, opening {}°", meters(*radius), significant(*opening_degrees))
        }
        Shape::Funnel { bottom_radius, top_radius, height } => {
            let [bottom, top, height] = [*bottom_radius, *top_radius, *height].map(meters);
            format!("funnel, radii {bottom} and {top}, height {height}")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_lead_back_to_the_rotation_that_they_are_of() {
        for degrees in [[0.0, 0.0, 0.0], [30.0, -80.0, 170.0], [-120.0, 45.0, 3.0]] {
            let there_and_back = degrees_of(turned_by(degrees));
            for (one, other) in degrees.into_iter().zip(there_and_back) {
                // Rounding of sines and of the arc that leads back, near its end at 80 degrees.
                assert!((one - other).abs() < 1e-9, "{degrees:?}: {there_and_back:?}");
            }
        }
    }
}
