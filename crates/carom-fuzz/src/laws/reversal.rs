//! An elastic world without friction, run back from its end with all velocities reversed, passes
//! through its former states.

use carom::DVec3;
use carom_scene::Scene;
use carom_scene::scene::{Force, Rule};

use super::pair::{Agreement, Law, Pair};
use super::trace::{Frame, Trace};

pub const LAW: Law = Law { name: "run back", pair };

fn pair(scene: &Scene, trace: &Trace) -> Option<Pair> {
    let is_driven = scene.simulation.thermostat.is_some() || scene.settings().shear_rate != 0.0;
    if scene.simulation.rule != Rule::Exact || is_driven || !is_reversible(scene) {
        return None;
    }
    // No further than to where a contact lasted: it began without an impact that could be run back.
    let is_over = |frame: &Frame| frame.in_zone || frame.in_contact;
    if trace.frames.iter().any(is_over) {
        return None;
    }
    let back = |frame: &mut Frame| {
        for body in &mut frame.bodies {
            (body.velocity, body.spin) = (-body.velocity, -body.spin);
        }
    };
    let pair = Pair::new(reversed(scene, trace)?, Agreement::Rounding, back);
    Some(Pair { is_backwards: true, ends: |frame| frame.in_zone || frame.in_contact, ..pair })
}

fn is_reversible(scene: &Scene) -> bool {
    let is_smooth = |friction: Option<f64>| friction.is_none_or(|it| it == 0.0);
    scene.emitters.is_empty()
        && scene.springs.is_empty()
        && scene.material_pairs.is_empty()
        && scene.spheres.iter().all(|it| {
            it.restitution == 1.0
                && it.restitution_law.is_none()
                && is_smooth(it.friction)
                && it.growth_speed == 0.0
        })
        && scene.colliders.iter().all(|it| {
            it.restitution == 1.0
                && it.restitution_law.is_none()
                && it.kick == 0.0
                && is_smooth(it.friction)
                && it.angular_velocity == [0.0; 3]
                && it.motion.is_empty()
        })
        && scene
            .forces
            .iter()
            .all(|it| matches!(it, Force::Gravity { .. } | Force::Constant { .. }))
}

/// Returns the end of the run as a scene, with all velocities reversed; `None` if its spheres are
/// others.
fn reversed(scene: &Scene, trace: &Trace) -> Option<Scene> {
    let mut scene = scene.clone();
    scene.simulation.allow_overlap = true;
    let end = trace.frames.last()?;
    if end.bodies.len() != scene.spheres.len() {
        return None;
    }
    for (sphere, body) in scene.spheres.iter_mut().zip(&end.bodies) {
        sphere.position = body.position.to_array();
        sphere.velocity = (-body.velocity).to_array();
        sphere.angular_velocity = (-body.spin).to_array();
    }
    for collider in &mut scene.colliders {
        let velocity = DVec3::from_array(collider.velocity);
        collider.position = (DVec3::from_array(collider.position) + end.time * velocity).to_array();
        collider.velocity = (-velocity).to_array();
    }
    Some(scene)
}
