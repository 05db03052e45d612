//! A scene moved by a small part of its size: the same world, in which all coordinates round
//! otherwise.

use carom::DVec3;
use carom_scene::Scene;
use carom_scene::scene::{Force, Motion};

/// Ways as parts of the largest coordinate: numbers of many bits, and so small that no threshold
/// that grows with coordinates changes by more.
const WAYS: [DVec3; 6] = [
    DVec3::new(0.013_719_2, -0.021_143_7, 0.017_317_3),
    DVec3::new(-0.019_731_7, 0.015_377_1, -0.012_937_9),
    DVec3::new(0.017_913_1, 0.011_271_3, -0.020_113_7),
    DVec3::new(-0.014_339_9, -0.018_617_3, 0.013_171_1),
    DVec3::new(0.020_749_3, -0.012_539_1, -0.016_811_9),
    DVec3::new(-0.011_887_7, 0.019_913_9, 0.015_731_3),
];

/// Returns the scene moved along each of some ways, with the ways \[m\]. `extent` is the farthest point of a sphere from
/// the origin along an axis \[m\].
pub fn elsewhere(scene: &Scene, extent: f64) -> impl Iterator<Item = (Scene, DVec3)> {
    let ways = WAYS.into_iter().map(move |way| extent * in_space(way, scene));
    ways.map(|way| (moved(scene, way), way))
}

/// Returns the part of a vector that does not lead out of the plane of a scene of two dimensions.
pub fn in_space(vector: DVec3, scene: &Scene) -> DVec3 {
    if scene.simulation.dimensions == 2 { vector.with_z(0.0) } else { vector }
}

fn moved(scene: &Scene, by: DVec3) -> Scene {
    let mut scene = scene.clone();
    scene.simulation.allow_overlap = true;
    let add = |place: &mut [f64; 3]| *place = (DVec3::from_array(*place) + by).to_array();
    scene.spheres.iter_mut().for_each(|it| add(&mut it.position));
    scene.emitters.iter_mut().for_each(|it| add(&mut it.position));
    scene.springs.iter_mut().filter_map(|it| it.anchor.as_mut()).for_each(add);
    for collider in &mut scene.colliders {
        add(&mut collider.position);
        for motion in &mut collider.motion {
            match motion {
                Motion::Turn { pivot, .. }
                | Motion::Swing { pivot, .. }
                | Motion::Keyframes { pivot, .. } => add(pivot),
                Motion::Steady { .. } | Motion::Oscillate { .. } => {}
            }
        }
    }
    for force in &mut scene.forces {
        match force {
            Force::PointAttractor { position, .. } | Force::Vortex { position, .. } => {
                add(position);
            }
            Force::Buoyancy { surface_height, gravity, .. } => {
                *surface_height -= by.dot(DVec3::from_array(*gravity).normalize_or_zero());
            }
            _ => {}
        }
    }
    scene
}
