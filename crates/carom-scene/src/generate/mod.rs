//! Generators of spheres.

mod random;
mod regular;

use carom::{DVec3, World};

use crate::bodies::{add_sphere, sphere};
use crate::error::Problem;
use crate::requirement::{check, check_positive};
use crate::scene::values::vector;
use crate::scene::{Generator, Sphere};

/// More spheres than this in one generator are a slip of the keyboard, and would fill the memory
/// (about 1 GB for the world alone).
const MOST_SPHERES: u64 = 10_000_000;

impl Generator {
    /// The spheres it stands for, one by one, when `world` holds what comes before them.
    pub(crate) fn spheres(&self, world: &World, path: &str) -> Result<Vec<Sphere>, Problem> {
        let centers = match self {
            Self::Row { count, start, step, .. } => regular::row(*count, [*start, *step], path)?,
            Self::Lattice { counts, start, spacing, .. } => {
                check_count(self.count(), &format!("{path}.counts"))?;
                regular::lattice(*counts, [*start, *spacing], path)?
            }
            Self::ClosePacking { counts, start, stacking, .. } => {
                check_count(self.count(), &format!("{path}.counts"))?;
                let spacing = self.spacing(path)?;
                regular::close_packing(*counts, *stacking, (*start, spacing), path)?
            }
            Self::Ring { count, center, radius, axis, .. } => {
                regular::ring(*count, (*center, *radius), *axis, path)?
            }
            Self::Random { .. } => return self.scatter(world, path),
        };
        Ok(centers.into_iter().map(|center| at(center, self.template())).collect())
    }

    /// Distance of neighbours in a close packing \[m\], a diameter unless given.
    fn spacing(&self, path: &str) -> Result<f64, Problem> {
        let Self::ClosePacking { spacing: Some(spacing), .. } = self else {
            return Ok(2.0 * sphere(self.template(), &format!("{path}.sphere"))?.radius);
        };
        check_positive(*spacing, &format!("{path}.spacing"))?;
        Ok(*spacing)
    }
}

/// A sphere of a generator whose place is this \[m\].
fn at(place: DVec3, template: &Sphere) -> Sphere {
    let position = (place + vector(template.position)).to_array();
    Sphere { position, ..template.clone() }
}

/// Adds the spheres of a generator, written at `path`, to a world.
pub(crate) fn fill(world: &mut World, generator: &Generator, path: &str) -> Result<(), Problem> {
    let spheres = generator.spheres(world, path)?;
    let path = format!("{path}.sphere");
    spheres.iter().try_for_each(|sphere| add_sphere(world, sphere, &path))
}

fn check_count(count: u64, path: &str) -> Result<(), Problem> {
    check((1..=MOST_SPHERES).contains(&count), path, || {
        format!("must make 1 to {MOST_SPHERES} spheres, not {count}")
    })
}
