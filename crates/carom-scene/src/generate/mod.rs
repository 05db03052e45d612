//! Generators of spheres and colliders.

mod count;
mod random;
mod regular;
mod rows;

use carom::{DVec3, World};

use self::count::check_spheres;
use crate::bodies::{add_sphere, sphere};
use crate::error::Problem;
use crate::requirement::check_positive;
use crate::scene::values::vector;
use crate::scene::{Generator, Sphere};

impl Generator {
    /// The spheres it stands for, one by one, when `world` holds what comes before them.
    pub(crate) fn spheres(&self, world: &World, path: &str) -> Result<Vec<Sphere>, Problem> {
        let centers = match self {
            Self::Row { count, start, step, .. } => regular::row(*count, [*start, *step], path)?,
            Self::Lattice { counts, start, spacing, .. } => {
                check_spheres(self.count(), &format!("{path}.counts"))?;
                regular::lattice(*counts, [*start, *spacing], path)?
            }
            Self::StaggeredRows(rows) => {
                let centers = rows.centers(path)?.into_iter();
                centers.map(|(center, _)| center).collect()
            }
            Self::ClosePacking { counts, start, spacing, stacking, sphere } => {
                check_spheres(self.count(), &format!("{path}.counts"))?;
                let spacing = distance(*spacing, sphere, path)?;
                regular::close_packing(*counts, *stacking, (*start, spacing), path)?
            }
            Self::Ring { count, center, radius, axis, .. } => {
                regular::ring(*count, (*center, *radius), *axis, path)?
            }
            Self::Random { .. } => return self.scatter(world, path),
        };
        let Some(template) = self.sphere() else {
            return Ok(Vec::new());
        };
        Ok(centers.into_iter().map(|center| at(center, template)).collect())
    }
}

/// A sphere of a generator whose place is this \[m\].
fn at(place: DVec3, template: &Sphere) -> Sphere {
    let position = (place + vector(template.position)).to_array();
    Sphere { position, ..template.clone() }
}

/// Distance of neighbours in a close packing \[m\], a diameter unless given.
fn distance(given: Option<f64>, template: &Sphere, path: &str) -> Result<f64, Problem> {
    let Some(spacing) = given else {
        return Ok(2.0 * sphere(template, &format!("{path}.sphere"))?.radius);
    };
    check_positive(spacing, &format!("{path}.spacing"))?;
    Ok(spacing)
}

/// Adds the spheres of a generator, written at `path`, to a world.
pub(crate) fn fill(world: &mut World, generator: &Generator, path: &str) -> Result<(), Problem> {
    let spheres = generator.spheres(world, path)?;
    let path = format!("{path}.sphere");
    spheres.iter().try_for_each(|sphere| add_sphere(world, sphere, &path))
}
