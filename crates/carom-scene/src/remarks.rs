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
        found.extend(
            of_trigger(collider)
                .map(|it| format!("{path}.{it} has no effect: a trigger deflects nothing")),
        );
        let is_law = collider.restitution_law.is_some();
        found.extend(of_restitution(&path, collider.restitution, is_law));
        found.extend(of_motion(&path, &collider.motion));
    }
    for (path, sphere) in spheres(scene) {
        found.extend(of_restitution(&path, sphere.restitution, sphere.restitution_law.is_some()));
    }
    for (name, material) in &scene.materials {
        let (path, is_law) = (format!("materials.{name}"), material.restitution_law.is_some());
        found.extend(of_restitution(&path, material.restitution.unwrap_or(1.0), is_law));
    }
    for (i, pair) in scene.material_pairs.iter().enumerate() {
        let (path, is_law) = (format!("material_pairs[{i}]"), pair.restitution_law.is_some());
        found.extend(of_restitution(&path, pair.restitution.unwrap_or(1.0), is_law));
    }
    found.extend(of_wells(scene));
    found
}

/// Returns every sphere that the scene describes with its path: single ones, and those of generators and emitters.
fn spheres(scene: &Scene) -> impl Iterator<Item = (String, &Sphere)> {
    let single = scene.spheres.iter().enumerate().map(|(i, it)| (format!("spheres[{i}]"), it));
    let generated = scene.generators.iter().enumerate().filter_map(|(i, generator)| {
        Some((format!("generators[{i}].{}.sphere", generator.kind()), generator.sphere()?))
    });
    let emitted = scene.emitters.iter().enumerate();
    let emitted = emitted.map(|(i, it)| (format!("emitters[{i}].sphere"), &it.sphere));
    single.chain(generated).chain(emitted)
}

/// Returns a field of a trigger that has no effect.
fn of_trigger(collider: &Collider) -> Option<&'static str> {
    match collider {
        _ if !collider.trigger => None,
        Collider { kick, .. } if *kick != 0.0 => Some("kick"),
        Collider { cushion: Some(_), .. } => Some("cushion"),
        Collider { surface_velocity, .. } if *surface_velocity != [0.0; 3] => {
            Some("surface_velocity")
        }
        _ => None,
    }
}

/// Returns a remark on square wells among spheres that all stay at rest: within a well no force acts.
fn of_wells(scene: &Scene) -> Option<String> {
    let simulation = &scene.simulation;
    let is_at_rest = |sphere: &Sphere| sphere.velocity == [0.0; 3] && sphere.growth_speed == 0.0;
    let starts = scene.generators.iter().any(|generator| match generator {
        Generator::Random { speed, .. } => *speed != 0.0,
        Generator::DenseFluid(fluid) => fluid.temperature != 0.0,
        _ => false,
    });
    let stays = |collider: &Collider| {
        collider.motion.is_empty()
            && [collider.velocity, collider.angular_velocity] == [[0.0; 3]; 2]
    };
    let is_idle = simulation.pair_potential.is_some()
        && simulation.thermostat.is_none()
        && scene.forces.is_empty()
        && !starts
        && spheres(scene).all(|(_, sphere)| is_at_rest(sphere))
        && scene.colliders.iter().all(stays);
    is_idle.then(|| {
        "simulation.pair_potential has no effect: every ball is at rest, and a well acts at its edge only".to_owned()
    })
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
    let has = |friction: Option<f64>| friction.is_some_and(|it| it > 0.0);
    spheres(scene).any(|(_, sphere)| has(sphere.friction))
        || scene.materials.values().any(|material| has(material.friction))
}

fn of_restitution(path: &str, restitution: f64, is_law: bool) -> Option<String> {
    (is_law && restitution != 1.0)
        .then(|| format!("{path}.restitution does not count beside `restitution_law`"))
}

/// Largest scalar product of two unit quaternions half a turn apart: rounding of sines and cosines.
const HALF_A_TURN: f64 = 1e-15;

/// Returns a remark on keyframes that turn by half a turn or more: a rotation from 0 to 360 degrees is no motion.
fn of_motion(path: &str, motion: &[Motion]) -> Option<String> {
    let is_far = |pair: &[[f64; 4]]| {
        let [from, to] = [pair[0], pair[1]].map(DQuat::from_array);
        from.dot(to) < HALF_A_TURN * from.length() * to.length()
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
