//! Draws a running world.

use carom::{SphereId, Spring};
use carom_render::{Ball, Drawing, Light, add_surroundings, bodies, spring_line};
use carom_scene::{Palette, Scene};

use super::running::{Running, Seen};

/// Draws these spheres, by number, with these springs, and the colliders of a running world at
/// `time` \[s\], which it must have reached.
pub fn draw(
    scene: &Scene,
    running: &Running,
    time: f64,
    (spheres, springs): (&[Seen], &[Spring]),
    palette: &Palette,
    drawing: &mut Drawing,
) {
    drawing.clear();
    drawing.light = Light::of_scene(scene);
    let all = scene.all_colliders();
    let colliders = all.iter().zip(running.world().colliders());
    for (i, ((written, (_, now)), pose)) in colliders.zip(running.poses(time)).enumerate() {
        if written.visible {
            drawing.add_collider(now.shape.clone(), pose, palette.collider(i), now.trigger);
        }
    }
    let place = |id: SphereId| {
        let found = spheres.binary_search_by_key(&id.number(), |seen| seen.number);
        Some(spheres[found.ok()?].position)
    };
    let boundary = running.world().settings().boundary;
    drawing.arrows.extend(springs.iter().filter_map(|it| spring_line(it, boundary, place)));
    drawing.balls.extend(spheres.iter().map(|seen| {
        let coat = palette.sphere(seen.number, seen.radius, seen.mass);
        Ball::from_sphere(seen.position, seen.radius, coat, seen.orientation)
    }));
    add_surroundings(&scene.forces, &bodies(running.world(), palette), drawing);
}
