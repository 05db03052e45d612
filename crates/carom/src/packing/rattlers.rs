//! Rattlers: spheres of a jammed packing that are free to move in their cage.

use crate::error::{Error, Subject};
use crate::report::BodyPair;
use crate::validate;
use crate::world::World;

/// Largest gap of a contact of a packing, relative to the sum of radii and multiplied by the reduced pressure.
const CONTACT: f64 = 100.0;
/// Reduced pressure below which no sphere is jammed.
const JAMMED: f64 = 1e6;

/// Returns the number of [`rattlers`] of a packing with this reduced pressure p: a gap of 100/p times the sum of
/// radii counts as a contact. `None` below a pressure of a million, where spheres are not jammed.
///
/// # Errors
/// [`Error::Invalid`] for a pressure that is not finite.
pub fn jammed_rattlers(world: &World, pressure: f64) -> Result<Option<usize>, Error> {
    if pressure < JAMMED {
        return Ok(None);
    }
    validate::positive("pressure", pressure).map_err(|invalid| invalid.about(Subject::Query))?;
    rattlers(world, CONTACT / pressure).map(Some)
}

/// Returns the number of rattlers of a packing: spheres with fewer than four contacts, three in two dimensions, with
/// colliders and with spheres that are not rattlers. A gap of less than `gap` times the sum of radii counts as a contact. Near jamming
/// gaps are about the inverse of the reduced pressure p, and larger where the force is small: 100/p suits, with p a
/// million or more.
///
/// Source: Torquato and Stillinger, Rev. Mod. Phys. 82, 2633 (2010), section III.
///
/// # Errors
/// [`Error::Invalid`] for a gap that is negative or not finite.
pub fn rattlers(world: &World, gap: f64) -> Result<usize, Error> {
    validate::non_negative("gap", gap).map_err(|invalid| invalid.about(Subject::Query))?;
    let spheres = world.spheres();
    // Spheres enlarged by the gap overlap if the original ones are in contact.
    let mut swollen = World::new(*world.settings())?;
    swollen.set_material_pairs(world.material_pairs().iter().copied())?;
    for (_, collider) in world.colliders() {
        swollen.add_collider(collider.clone())?;
    }
    for index in 0..spheres.len() {
        let sphere = spheres.get(index);
        swollen
            .add_sphere(sphere.with_radius(sphere.radius * (1.0 + gap)).with_growth_speed(0.0))?;
    }
    let mut neighbours = vec![Vec::new(); spheres.len()];
    let mut held_by_colliders = vec![0; spheres.len()];
    let index_of = |id| swollen.spheres().index_of(id).unwrap_or_default();
    for overlap in swollen.overlaps(0.0) {
        match overlap.between {
            BodyPair::Spheres(first, second) => {
                let [first, second] = [first, second].map(index_of);
                neighbours[first].push(second);
                neighbours[second].push(first);
            }
            BodyPair::Collider { sphere, .. } => held_by_colliders[index_of(sphere)] += 1,
        }
    }
    let mut contacts: Vec<usize> =
        neighbours.iter().zip(&held_by_colliders).map(|(near, walls)| near.len() + walls).collect();
    // One more than the number of dimensions holds a sphere in place.
    let fewest = world.settings().dimensions as usize + 1;
    let mut is_rattler = vec![false; spheres.len()];
    let mut loose: Vec<usize> =
        (0..spheres.len()).filter(|&index| contacts[index] < fewest).collect();
    while let Some(index) = loose.pop() {
        if std::mem::replace(&mut is_rattler[index], true) {
            continue;
        }
        for &other in &neighbours[index] {
            contacts[other] -= 1;
            if contacts[other] < fewest && !is_rattler[other] {
                loose.push(other);
            }
        }
    }
    Ok(is_rattler.iter().filter(|is| **is).count())
}
