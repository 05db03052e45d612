//! Draws a world: its spheres and colliders in the colours of its scene.

use carom::{Boundary, DQuat, DVec3, SphereId, Spring, SpringEnd, World};
use carom_scene::scene::Color;
use carom_scene::{Palette, Scene};

use crate::drawing::{Arrow, Ball, Drawing, Light, Pattern};
use crate::orbits::Body;
use crate::surroundings::add_surroundings;

/// Fills `drawing` with a world that has the colliders of `scene` in the same order. A ball has
/// white bands if `rotation` returns an orientation for its number. Other balls are banded if the
/// world tracks their orientation ([`World::has_spin`]), else plain.
pub fn draw_world(
    scene: &Scene,
    world: &World,
    palette: &Palette,
    rotation: impl Fn(u64) -> Option<DQuat>,
    drawing: &mut Drawing,
) {
    drawing.clear();
    drawing.light = Light::of_scene(scene);
    let all = scene.all_colliders();
    for (i, (collider, (_, now))) in all.iter().zip(world.colliders()).enumerate() {
        if collider.visible {
            drawing.add_collider(now.shape.clone(), now.pose, palette.collider(i), now.trigger);
        }
    }
    let (spheres, has_spin) = (world.spheres(), world.has_spin());
    let place = |id: SphereId| Some(spheres.positions()[spheres.ids().binary_search(&id).ok()?]);
    let boundary = world.settings().boundary;
    let springs = world.springs().filter_map(|(_, spring)| spring_line(spring, boundary, place));
    drawing.arrows.extend(springs);
    for (i, id) in spheres.ids().iter().enumerate() {
        let (radius, mass) = (spheres.radii()[i], spheres.masses()[i]);
        let coat = palette.sphere(id.number(), radius, mass);
        let orientation = has_spin.then(|| spheres.get(i).orientation);
        let ball = Ball::from_sphere(spheres.positions()[i], radius, coat, orientation);
        drawing.balls.push(match rotation(id.number()) {
            Some(rotation) => Ball { rotation, pattern: Pattern::Striped, ..ball },
            None => ball,
        });
    }
    add_surroundings(&scene.forces, &bodies(world, palette), drawing);
}

/// Returns the spheres of a world, as bodies that may have orbits.
pub fn bodies(world: &World, palette: &Palette) -> Vec<Body> {
    let spheres = world.spheres();
    let body = |(i, id): (usize, &SphereId)| {
        let (radius, mass) = (spheres.radii()[i], spheres.masses()[i]);
        let color = palette.sphere(id.number(), radius, mass).color;
        Body { position: spheres.positions()[i], velocity: spheres.velocities()[i], mass, color }
    };
    spheres.ids().iter().enumerate().map(body).collect()
}

/// Returns the line that shows a spring or a thread between spheres at the positions that `place`
/// returns \[m\]; `None` if a sphere does not exist. In a periodic box the line goes to the nearest
/// image.
pub fn spring_line(
    spring: &Spring,
    boundary: Boundary,
    place: impl Fn(SphereId) -> Option<DVec3>,
) -> Option<Arrow> {
    let end = match spring.to {
        SpringEnd::Sphere(other) => place(other)?,
        SpringEnd::Point(point) => point,
    };
    let start = place(spring.sphere)?;
    let end = start + boundary.nearest_image(end - start);
    Some(Arrow { start, end, color: SPRING, width: 2.0, head: false, in_front: false })
}

/// The colour of springs and threads.
const SPRING: Color = [0.50, 0.47, 0.41];

/// Orientation of a ball that rolls without slipping, for display under rules without friction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Roll {
    /// Rotation from the ball's frame to the world.
    pub rotation: DQuat,
}

impl Roll {
    /// The orientation at the start.
    pub const START: Self = Self { rotation: DQuat::IDENTITY };

    /// Rolls by `way` \[m\] over a floor with the unit normal `up`; `radius` \[m\] is that of the
    /// ball.
    pub fn on(&mut self, way: DVec3, up: DVec3, radius: f64) {
        let turn = up.cross(way) / radius;
        self.rotation = (DQuat::from_scaled_axis(turn) * self.rotation).normalize();
    }
}
