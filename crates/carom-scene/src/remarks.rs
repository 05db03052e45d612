//! Remarks on valid scenes: fields that have no effect, and motions that may not be as meant.

use carom::DQuat;

use crate::scene::{Collider, Generator, Motion, Scene, Shape, Sphere};

/// Returns what in a valid scene may not be as meant, one sentence each, with the path of the field.
pub fn remarks(scene: &Scene) -> Vec<String> {
    let mut found = Vec::new();
    let has_friction = has_friction(scene);
    for (i, collider) in scene.colliders.iter().enumerate() {
        let path = format!("colliders[{i}]");
        found.extend(
            of_belt(collider, has_friction).map(|it| format!("{path}.surface_velocity {it}")),
        );
        let is_law = collider.restitution_law.is_some();
        found.extend(of_restitution(&path, collider.restitution, is_law));
        found.extend(of_motion(&path, &collider.motion));
    }
    for (i, sphere) in scene.spheres.iter().enumerate() {
        let path = format!("spheres[{i}]");
        found.extend(of_restitution(&path, sphere.restitution, sphere.restitution_law.is_some()));
    }
    found
}

/// Returns why a belt has no effect.
fn of_belt(collider: &Collider, has_friction: bool) -> Option<&'static str> {
    let [x, y, z] = collider.surface_velocity;
    let is_flat =
        matches!(collider.shape, Shape::HalfSpace | Shape::Rectangle { .. } | Shape::Disc { .. });
    match collider.friction {
        _ if [x, y, z] == [0.0; 3] || collider.trigger => None,
        _ if is_flat && [x, z] == [0.0; 2] => {
            Some("has no effect: it is along the normal of the surface, and friction acts across")
        }
        Some(0.0) => Some("has no effect without friction"),
        None if !has_friction => Some("has no effect: neither it nor a sphere has friction"),
        _ => None,
    }
}

/// Returns whether a sphere or a material has friction.
fn has_friction(scene: &Scene) -> bool {
    let of_generators = scene.generators.iter().filter_map(Generator::sphere);
    let of_emitters = scene.emitters.iter().map(|emitter| &emitter.sphere);
    let mut spheres = scene.spheres.iter().chain(of_generators).chain(of_emitters);
    let has = |friction: Option<f64>| friction.is_some_and(|it| it > 0.0);
    spheres.any(|sphere: &Sphere| has(sphere.friction))
        || scene.materials.values().any(|material| has(material.friction))
}

fn of_restitution(path: &str, restitution: f64, is_law: bool) -> Option<String> {
    (is_law && restitution != 1.0)
        .then(|| format!("{path}.restitution does not count beside `restitution_law`"))
}

/// Returns a remark on keyframes that turn by half a turn or more: a rotation from 0 to 360 degrees is no motion.
fn of_motion(path: &str, motion: &[Motion]) -> Option<String> {
    let is_far = |pair: &[[f64; 4]]| {
        let [from, to] = [pair[0], pair[1]].map(DQuat::from_array);
        from.dot(to) < 0.0
    };
    let turns = motion.iter().any(|part| match part {
        Motion::Keyframes { rotations, .. } => rotations.windows(2).any(is_far),
        _ => false,
    });
    turns.then(|| {
        format!(
            "{path}.motion turns the shorter way from each keyframe to the next: give keyframes less than half a turn \
             apart, or `turn`"
        )
    })
}
