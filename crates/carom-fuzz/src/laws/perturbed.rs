//! A scene with its spheres moved a little: the distance between its run and that of the scene
//! shows what rounding may do.

use carom::DVec3;
use carom_scene::Scene;

/// Size of the changes, as a part of coordinates and of the largest speed: thousands of their
/// roundings.
pub const SIZE: f64 = 1e-12;

/// Returns the scene stretched by [`SIZE`] and with changed velocities, or the opposite of both, so
/// that each gap of the size of rounding is open in one of them and closed in the other.
pub fn perturbed(scene: &Scene, is_opposite: bool) -> Scene {
    let size = if is_opposite { -SIZE } else { SIZE };
    let mut scene = scene.clone();
    scene.simulation.allow_overlap = true;
    let speeds = scene.spheres.iter().map(|it| DVec3::from_array(it.velocity).length());
    let speed = speeds.fold(0.0, f64::max);
    let mut number = 0;
    for sphere in &mut scene.spheres {
        for axis in 0..3 {
            number += 1;
            sphere.position[axis] *= 1.0 + size;
            if axis < scene.simulation.dimensions as usize {
                sphere.velocity[axis] += size * speed * spread(number);
            }
        }
    }
    scene
}

/// Returns a number from -1 to 1 that differs for each `number`: the fractional part of its
/// multiple of the golden section.
fn spread(number: u32) -> f64 {
    2.0 * (f64::from(number) * 0.618_033_988_749_894_9).fract() - 1.0
}
