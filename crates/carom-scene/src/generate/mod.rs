//! Creates the spheres and colliders of generators.

mod count;
mod dense_fluid;
mod numbers;
mod place;
mod random;
mod regular;
mod rows;

use std::borrow::Cow;

use carom::{DQuat, DVec3, World};

use self::count::check_count;
pub(crate) use self::numbers::Numbers;
use self::place::Place;
use crate::bodies::{add_sphere, sphere};
use crate::error::Problem;
use crate::materials::MaterialNumbers;
use crate::requirement::check_positive;
use crate::scene::values::vector;
use crate::scene::{Collider, Generator, Scene, Sphere};

impl Generator {
    /// Creates the spheres of the generator. `world` holds the spheres and colliders before them.
    pub(crate) fn spheres(
        &self,
        world: &World,
        path: &str,
        materials: &MaterialNumbers,
    ) -> Result<Vec<Sphere>, Problem> {
        match self {
            Self::Random { sphere, .. } => {
                let path_of_sphere = format!("{path}.sphere");
                let material = materials.number(sphere.material.as_deref(), &path_of_sphere)?;
                return self.scatter(world, material, path);
            }
            Self::DenseFluid(fluid) => {
                check_count(self, path)?;
                return dense_fluid::spheres(fluid, world, path);
            }
            _ => {}
        }
        let places = self.all_places(world.settings().dimensions, path)?;
        let Some(template) = self.sphere() else { return Ok(Vec::new()) };
        Ok(places.iter().map(|place| at(place.center, template)).collect())
    }

    /// Creates the colliders of the generator.
    pub(crate) fn colliders(&self, path: &str) -> Result<Vec<Collider>, Problem> {
        let Some(template) = self.collider() else { return Ok(Vec::new()) };
        let turned = |place: &Place| match self {
            Self::Ring(ring) => turned(template, regular::turn_on_ring(ring, place.numbers[0] - 1)),
            _ => template.clone(),
        };
        let collider = |place: &Place| {
            let turned = turned(place);
            let position = (place.center + vector(turned.position)).to_array();
            Collider { name: place.named(&template.name), position, ..turned }
        };
        Ok(self.all_places(3, path)?.iter().map(collider).collect())
    }

    /// Places of a regular generator in 2 or 3 dimensions; empty for a random one, whose places depend on the world, and
    /// for a fluid.
    fn all_places(&self, dimensions: u32, path: &str) -> Result<Vec<Place>, Problem> {
        check_count(self, path)?;
        match self {
            Self::Row(row) => regular::row(row, path),
            Self::Lattice(lattice) => regular::lattice(lattice, path),
            Self::StaggeredRows(rows) => rows::staggered(rows, path),
            Self::ClosePacking { counts, start, spacing, stacking, sphere } => {
                let spacing = distance(*spacing, sphere, path)?;
                let stacking = (dimensions == 3).then_some(*stacking);
                regular::close_packing(*counts, stacking, (*start, spacing), path)
            }
            Self::Ring(ring) => regular::ring(ring, path),
            Self::Random { .. } | Self::DenseFluid(_) => Ok(Vec::new()),
        }
    }
}

impl Scene {
    /// Returns all colliders in the order of the world: the single ones, then those of generators.
    /// An invalid generator adds none.
    pub fn all_colliders(&self) -> Cow<'_, [Collider]> {
        if self.generators.iter().all(|generator| generator.collider().is_none()) {
            return Cow::Borrowed(&self.colliders);
        }
        let generated = self.generators.iter().filter_map(|generator| generator.colliders("").ok());
        Cow::Owned(self.colliders.iter().cloned().chain(generated.flatten()).collect())
    }
}

/// Turns a collider, with its velocities, about the origin.
fn turned(collider: &Collider, turn: DQuat) -> Collider {
    let rotation = DQuat::from_array(collider.rotation);
    let turned = |written| (turn * vector(written)).to_array();
    Collider {
        position: turned(collider.position),
        rotation: (turn * rotation).to_array(),
        velocity: turned(collider.velocity),
        angular_velocity: turned(collider.angular_velocity),
        motion: collider.motion.iter().map(|part| part.turned(&turned)).collect(),
        ..collider.clone()
    }
}

/// Copies the sphere of a generator to a place \[m\].
fn at(place: DVec3, template: &Sphere) -> Sphere {
    let position = (place + vector(template.position)).to_array();
    Sphere { position, ..template.clone() }
}

/// Distance of neighbours in a close packing \[m\]; a diameter if the scene states none.
fn distance(given: Option<f64>, template: &Sphere, path: &str) -> Result<f64, Problem> {
    let Some(spacing) = given else {
        return Ok(2.0 * sphere(template, &format!("{path}.sphere"))?.radius);
    };
    check_positive(spacing, &format!("{path}.spacing"))?;
    Ok(spacing)
}

/// Adds the spheres of the generator at `path` to a world.
pub(crate) fn fill(
    world: &mut World,
    generator: &Generator,
    path: &str,
    materials: &MaterialNumbers,
) -> Result<(), Problem> {
    let spheres = generator.spheres(world, path, materials)?;
    let path = format!("{path}.sphere");
    spheres.iter().try_for_each(|sphere| add_sphere(world, sphere, &path, materials))
}
