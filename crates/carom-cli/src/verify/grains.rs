//! Grains: many balls under gravity that fall, settle and flow under the rule `contact`.

use carom::{BodyPair, ColliderId, CombineRule, Contact, DVec3, Error, Friction, Gravity};
use carom::{Sphere, World};

use super::setup::{FRAME, G, half_space, world};
use crate::numbers::Numbers;

/// Diameter of a grain \[m\]; for flowing grains, a sub-step is an eightieth of `sqrt(d/g)`.
pub const DIAMETER: f64 = 0.3;
/// Distance of grains before they fall, in diameters; the packing fraction is 0.24.
const SPACING: f64 = 1.3;

/// Creates an empty world with gravity, in which the smaller coefficient of friction counts.
pub fn empty() -> Result<World, Error> {
    let mut world = world(Contact::default().into())?;
    world.set_settings(world.settings().with_friction_combine_rule(CombineRule::Minimum))?;
    world.add_force(Gravity::new(DVec3::new(0.0, -G, 0.0)))?;
    Ok(world)
}

/// Creates a grain that does not bounce.
pub fn grain(diameter: f64, friction: impl Into<Friction>) -> Sphere {
    Sphere::new(DVec3::ZERO, 0.5 * diameter).with_restitution(0.0).with_friction(friction)
}

/// Adds a floor at height 0 on which nothing bounces.
pub fn add_floor(world: &mut World, friction: impl Into<Friction>) -> Result<ColliderId, Error> {
    let floor = half_space(DVec3::ZERO, DVec3::Y).with_restitution(0.0);
    world.add_collider(floor.with_friction(friction))
}

/// Adds four walls around a square of this width about the y axis.
pub fn add_shaft(world: &mut World, width: f64, friction: f64) -> Result<[ColliderId; 4], Error> {
    let mut add = |normal: DVec3| {
        let wall = half_space(-0.5 * width * normal, normal).with_restitution(0.0);
        world.add_collider(wall.with_friction(friction))
    };
    Ok([add(DVec3::X)?, add(DVec3::NEG_X)?, add(DVec3::Z)?, add(DVec3::NEG_Z)?])
}

/// Puts `count` grains into a shaft of this width above a floor, in loose layers with random
/// shifts.
pub fn fill(world: &mut World, grain: Sphere, count: usize, width: f64) -> Result<(), Error> {
    let mut numbers = Numbers::new(1);
    let diameter = 2.0 * grain.radius;
    let row = ((width / diameter - 1.0) / SPACING) as usize + 1;
    let inside = 0.5 * (width - diameter);
    let spacing = 2.0 * inside / (row - 1).max(1) as f64;
    let shift = 0.5 * (SPACING - 1.0) * diameter;
    let [low, high] = [DVec3::new(-inside, 0.0, -inside), DVec3::new(inside, f64::MAX, inside)];
    for number in 0..count {
        let [x, z] = [number % row, number / row % row].map(|it| it as f64 * spacing - inside);
        let y = (0.5 + SPACING * ((number / (row * row)) as f64 + 0.5)) * diameter;
        let shake = shift * DVec3::from_array([(); 3].map(|()| numbers.between(-1.0, 1.0)));
        let place = (DVec3::new(x, y, z) + shake).clamp(low, high);
        world.add_sphere(grain.with_position(place))?;
    }
    Ok(())
}

/// Steps for `time` \[s\], or until nothing moves.
pub fn settle(world: &mut World, time: f64) -> Result<(), Error> {
    let end = world.time() + time - 0.5 * FRAME;
    while world.time() < end {
        world.step(FRAME)?;
        if world.spheres().velocities().iter().all(|velocity| *velocity == DVec3::ZERO) {
            break;
        }
    }
    Ok(())
}

/// Height of the highest centre \[m\].
pub fn top(world: &World) -> f64 {
    world.spheres().positions().iter().map(|position| position.y).fold(0.0, f64::max)
}

/// Contacts of spheres with a collider: point, and normal and tangential force on the sphere \[N\].
pub fn contacts_with(
    world: &World,
    wanted: ColliderId,
) -> impl Iterator<Item = (DVec3, f64, DVec3)> {
    world.contacts().into_iter().filter_map(move |contact| match contact.between {
        BodyPair::Collider { collider, .. } if collider == wanted => {
            Some((contact.point, contact.normal_force, contact.tangential_force))
        }
        _ => None,
    })
}
