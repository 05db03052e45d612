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

    /// Returns a point in the unit cube, or in two dimensions in the unit square at z = 0.
    pub fn vector(&mut self, dimensions: u32) -> DVec3 {
        let (x, y) = (self.unit(), self.unit());
        DVec3::new(x, y, if dimensions == 2 { 0.0 } else { self.unit() })
    }

    /// Returns a unit vector, uniformly distributed: a random point of the unit ball, or disc, normalized.
    pub fn direction(&mut self, dimensions: u32) -> DVec3 {
        loop {
            let point = in_space(2.0 * self.vector(dimensions) - 1.0, dimensions);
            let length_squared = point.length_squared();
            if (1e-6..=1.0).contains(&length_squared) {
                return point / length_squared.sqrt();
            }
        }
    }
}

/// Part of a vector in 2 or 3 dimensions: in the plane its z is 0.
pub(super) fn in_space(vector: DVec3, dimensions: u32) -> DVec3 {
    if dimensions == 2 { vector.with_z(0.0) } else { vector }
}

/// Checks that a box between two corners \[m\] contains the plane z = 0, where there are two dimensions.
pub(super) fn check_plane(
    [min, max]: [DVec3; 2],
    dimensions: u32,
    path: &str,
) -> Result<(), Problem> {
    check(dimensions == 3 || (min.z <= 0.0 && max.z >= 0.0), path, || {
        "must contain the plane z = 0 with `min`, in two dimensions".into()
    })
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
