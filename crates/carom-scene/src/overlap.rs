//! Refuses spheres that overlap at the start.

use carom::World;

use crate::error::Problem;
use crate::scene::Scene;

/// Refuses spheres that overlap each other or a collider by more than a rounding error.
pub(crate) fn refuse(
    scene: &Scene,
    world: &World,
    first_of_generator: &[usize],
) -> Result<(), Problem> {
    let is_real = |overlap: &carom::Overlap| overlap.depth > rounding(world, overlap);
    let Some(overlap) = world.find_overlap(is_real) else {
        return Ok(());
    };
    let overlap = with_lowest(world, overlap);
    let index = |sphere: carom::SphereId| sphere.number() as usize;
    let path = |sphere: carom::SphereId| match first_of_generator
        .partition_point(|&first| first <= index(sphere))
    {
        0 => format!("spheres[{}]", index(sphere)),
        generator => format!("generators[{}]", generator - 1),
    };
    let (sphere, other) = match overlap.between {
        carom::BodyPair::Spheres(first, second) => {
            (second, format!("sphere number {} ({})", first.number(), path(first)))
        }
        carom::BodyPair::Collider { collider, sphere } => {
            let number = collider.number();
            let colliders = scene.all_colliders();
            let name = colliders.get(number as usize).map_or("", |collider| &collider.name);
            let name = if name.is_empty() { String::new() } else { format!(" \"{name}\"") };
            (sphere, format!("colliders[{number}]{name}"))
        }
    };
    let text = format!(
        "sphere number {} overlaps {other} by {:.3e} m at the start; move it, or set \
         simulation.allow_overlap = true",
        sphere.number(),
        overlap.depth,
    );
    Err(Problem::new(path(sphere), text))
}

/// Returns the overlap of a pair's first sphere with the sphere of the lowest number.
fn with_lowest(world: &World, overlap: carom::Overlap) -> carom::Overlap {
    let carom::BodyPair::Spheres(first, _) = overlap.between else { return overlap };
    let spheres = world.spheres();
    let (center, radius) = {
        let index = first.number() as usize;
        (spheres.positions()[index], spheres.radii()[index])
    };
    let others = spheres.ids().iter().zip(spheres.positions()).zip(spheres.radii());
    let mut pairs = others.filter(|((id, _), _)| **id != first).map(|((&id, &other), &r)| {
        let between = carom::BodyPair::Spheres(first.min(id), first.max(id));
        carom::Overlap { between, depth: radius + r - center.distance(other) }
    });
    pairs.find(|pair| pair.depth > rounding(world, pair)).unwrap_or(overlap)
}

/// Overlap \[m\] that touching bodies can have through rounding: numbers in a file have fewer
/// digits than a double, and coordinates far from the origin are coarse.
fn rounding(world: &World, overlap: &carom::Overlap) -> f64 {
    const OF_RADIUS: f64 = 1e-9;
    const OF_COORDINATES: f64 = 8.0 * f64::EPSILON;
    let sizes = |id: carom::SphereId| {
        let index = id.number() as usize;
        let (radius, center) = (world.spheres().radii()[index], world.spheres().positions()[index]);
        (radius, center.abs().max_element())
    };
    let (radius, coordinate) = match overlap.between {
        carom::BodyPair::Collider { sphere, .. } => sizes(sphere),
        carom::BodyPair::Spheres(first, second) => {
            let (first, second) = (sizes(first), sizes(second));
            (first.0.min(second.0), first.1.max(second.1))
        }
    };
    OF_RADIUS * radius + OF_COORDINATES * coordinate
}
