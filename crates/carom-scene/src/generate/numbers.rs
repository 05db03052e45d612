//! Random numbers, and the radii that are drawn with them.

use carom::DVec3;
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64;

use crate::bodies::sphere;
use crate::error::Problem;
use crate::requirement::{check, check_positive};
use crate::scene::Sphere;

/// Random numbers that are the same on every platform.
pub(crate) struct Numbers(Pcg64);

impl Numbers {
    /// Begins the sequence of a seed.
    pub fn new(seed: u64) -> Self {
        Self(Pcg64::seed_from_u64(seed))
    }

    /// Returns a number in [0, 1).
    pub fn unit(&mut self) -> f64 {
        // The top 53 bits: every value is a multiple of 2^-53, so this is exact.
        (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Returns a point in the unit cube.
    pub fn vector(&mut self) -> DVec3 {
        DVec3::new(self.unit(), self.unit(), self.unit())
    }

    /// Returns a unit vector, uniformly distributed: a random point of the unit ball, normalized.
    pub fn direction(&mut self) -> DVec3 {
        loop {
            let point = 2.0 * self.vector() - 1.0;
            let length_squared = point.length_squared();
            if (1e-6..=1.0).contains(&length_squared) {
                return point / length_squared.sqrt();
            }
        }
    }
}

/// Smallest and largest radius of spheres with a size of their own or a range of sizes.
pub(super) fn radii(
    template: &Sphere,
    range: Option<[f64; 2]>,
    path: &str,
) -> Result<[f64; 2], Problem> {
    let Some([smallest, largest]) = range else {
        let sphere_path = format!("{path}.sphere");
        let radius = sphere(template, &sphere_path)?.radius;
        check_positive(radius, &format!("{sphere_path}.radius"))?;
        return Ok([radius, radius]);
    };
    // The sizes of the template are not used, but must be valid.
    for (field, size) in [("radius", template.radius), ("diameter", template.diameter)] {
        size.map_or(Ok(()), |size| check_positive(size, &format!("{path}.sphere.{field}")))?;
    }
    let are_in_order = smallest > 0.0 && largest >= smallest && largest.is_finite();
    check(are_in_order, &format!("{path}.radius_range"), || {
        format!("must be two positive radii in order, not [{smallest}, {largest}]")
    })?;
    Ok([smallest, largest])
}
