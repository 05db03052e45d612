//! The same world in uniform motion: spheres, colliders and the air go along.

use carom::DVec3;
use carom_scene::Scene;
use carom_scene::scene::{Boundary, Force, Motion, Rule};

use super::elsewhere::in_space;
use super::pair::{Agreement, Law, Pair};
use super::trace::Trace;

pub const LAW: Law = Law { name: "in uniform motion", pair };

/// How fast \[m/s\]: numbers of few bits, so that they are added to others with one rounding.
const VELOCITY: DVec3 = DVec3::new(2.5, -1.75, 3.25);

fn pair(scene: &Scene, _: &Trace) -> Option<Pair> {
    let is_fixed = match scene.simulation.rule {
        // A heap on what moves does not sleep, and surfaces are where a sub-step begins.
        Rule::Contact => true,
        // Surfaces are where a frame begins.
        Rule::Discrete | Rule::Bisect => !scene.colliders.is_empty(),
        // What moves has no images.
        Rule::Exact => scene.simulation.boundary != Boundary::Open && !scene.colliders.is_empty(),
    };
    // What slides meets the seams of a floor that moves: without a force, what an impact has stopped.
    let is_plastic =
        scene.colliders.len() > 1 && scene.colliders.iter().any(|it| it.restitution == 0.0);
    let is_fixed = is_fixed
        || is_plastic
        || !scene.emitters.is_empty()
        || !scene.generators.is_empty()
        // Its temperature is that of motion relative to rest.
        || scene.simulation.thermostat.is_some()
        || scene.settings().shear_rate != 0.0
        || scene.spheres.iter().any(|it| it.growth_speed != 0.0)
        || scene.springs.iter().any(|it| it.anchor.is_some())
        || scene.forces.iter().any(has_a_place);
    if is_fixed {
        return None;
    }
    let velocity = in_space(VELOCITY, scene);
    let pair = Pair::new(moving(scene, velocity), Agreement::Rounding, move |frame| {
        for body in &mut frame.bodies {
            body.position -= frame.time * velocity;
            body.velocity -= velocity;
        }
    });
    // Contacts with what moves are others: their pieces end with frames, and friction on them is stepped.
    Some(Pair { ends: |frame| frame.in_zone || frame.in_contact, ..pair })
}

fn has_a_place(force: &Force) -> bool {
    match force {
        Force::Constant { .. }
        | Force::Gravity { .. }
        | Force::MutualGravity { .. }
        | Force::ViscousDrag { .. }
        | Force::Wind { .. }
        | Force::QuadraticDrag { .. } => false,
        Force::PointAttractor { .. } | Force::Vortex { .. } | Force::Buoyancy { .. } => true,
    }
}

fn moving(scene: &Scene, by: DVec3) -> Scene {
    let mut scene = scene.clone();
    let add = |velocity: &mut [f64; 3]| {
        *velocity = (DVec3::from_array(*velocity) + by).to_array();
    };
    scene.spheres.iter_mut().for_each(|it| add(&mut it.velocity));
    for collider in &mut scene.colliders {
        if collider.motion.is_empty() {
            add(&mut collider.velocity);
        } else {
            collider.motion.push(Motion::Steady { velocity: by.to_array() });
        }
    }
    for force in &mut scene.forces {
        match force {
            Force::Wind { velocity, .. } | Force::QuadraticDrag { wind: velocity, .. } => {
                add(velocity);
            }
            &mut Force::ViscousDrag { coefficient } => {
                *force = Force::Wind { velocity: by.to_array(), coefficient };
            }
            _ => {}
        }
    }
    scene
}
