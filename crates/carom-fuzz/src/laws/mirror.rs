//! The mirror image of a world, with left and right interchanged: nothing prefers a side.

use carom_scene::Scene;
use carom_scene::scene::{Collider, Force, Motion, Rule, Shape, Side, Sphere};

use super::pair::{Agreement, Law, Pair};
use super::trace::Trace;

pub const LAW: Law = Law { name: "mirrored", pair };

fn pair(scene: &Scene, _: &Trace) -> Option<Pair> {
    // Sweeps go in one direction, and random velocities and shear are not mirrored.
    let is_sheared = scene.settings().shear_rate != 0.0;
    if scene.simulation.rule == Rule::Contact || scene.simulation.thermostat.is_some() || is_sheared
    {
        return None;
    }
    // What a generator draws is not mirrored.
    if !scene.generators.is_empty() {
        return None;
    }
    // The cells of height fields and tracks are divided along the diagonals of one direction.
    let has_cells = |it: &Collider| matches!(it.shape, Shape::HeightField(_) | Shape::Track(_));
    if scene.colliders.iter().any(has_cells) {
        return None;
    }
    let pair = Pair::new(mirrored(scene), Agreement::Rounding, |frame| {
        for body in &mut frame.bodies {
            body.position.x = -body.position.x;
            body.velocity.x = -body.velocity.x;
            (body.spin.y, body.spin.z) = (-body.spin.y, -body.spin.z);
        }
    });
    Some(Pair { ends: |frame| frame.in_zone, ..pair })
}

fn mirrored(scene: &Scene) -> Scene {
    let mut scene = scene.clone();
    scene.forces.iter_mut().for_each(mirror_force);
    scene.spheres.iter_mut().for_each(mirror_sphere);
    scene.colliders.iter_mut().for_each(mirror_collider);
    scene.springs.iter_mut().filter_map(|it| it.anchor.as_mut()).for_each(mirror);
    for emitter in &mut scene.emitters {
        mirror(&mut emitter.position);
        mirror_turn(&mut emitter.rotation);
        // In the emitter's frame, which is mirrored with it.
        mirror_sphere(&mut emitter.sphere);
    }
    scene
}

/// A place, or a vector.
fn mirror(vector: &mut [f64; 3]) {
    vector[0] = -vector[0];
}

/// An axis about which something turns.
fn mirror_axis(vector: &mut [f64; 3]) {
    (vector[1], vector[2]) = (-vector[1], -vector[2]);
}

fn mirror_turn([_, y, z, _]: &mut [f64; 4]) {
    (*y, *z) = (-*y, -*z);
}

fn mirror_sphere(sphere: &mut Sphere) {
    mirror(&mut sphere.position);
    mirror(&mut sphere.velocity);
    mirror_turn(&mut sphere.orientation);
    mirror_axis(&mut sphere.angular_velocity);
}

fn mirror_collider(collider: &mut Collider) {
    mirror(&mut collider.position);
    mirror(&mut collider.velocity);
    // In the collider's frame, which is mirrored with it.
    mirror(&mut collider.surface_velocity);
    mirror_turn(&mut collider.rotation);
    mirror_axis(&mut collider.angular_velocity);
    for motion in &mut collider.motion {
        match motion {
            Motion::Steady { velocity: it } | Motion::Oscillate { axis: it, .. } => mirror(it),
            Motion::Turn { axis, pivot, .. } | Motion::Swing { axis, pivot, .. } => {
                mirror_axis(axis);
                mirror(pivot);
            }
            Motion::Keyframes { positions, rotations, pivot, .. } => {
                positions.iter_mut().for_each(mirror);
                rotations.iter_mut().for_each(mirror_turn);
                mirror(pivot);
            }
        }
    }
    // Shapes of revolution are their own mirror images.
    match &mut collider.shape {
        Shape::Container { open, .. } => {
            for side in open {
                *side = match *side {
                    Side::Left => Side::Right,
                    Side::Right => Side::Left,
                    other => other,
                };
            }
        }
        Shape::Mesh(mesh) => {
            mesh.vertices.iter_mut().for_each(mirror);
            mesh.triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
        }
        _ => {}
    }
}

fn mirror_force(force: &mut Force) {
    match force {
        Force::Constant { force: it }
        | Force::Gravity { acceleration: it }
        | Force::PointAttractor { position: it, .. }
        | Force::Wind { velocity: it, .. }
        | Force::QuadraticDrag { wind: it, .. } => mirror(it),
        Force::Vortex { position, axis, .. } => {
            mirror(position);
            mirror_axis(axis);
        }
        Force::Buoyancy { gravity, .. } => mirror(gravity),
        Force::ViscousDrag { .. } | Force::MutualGravity { .. } => {}
    }
}
