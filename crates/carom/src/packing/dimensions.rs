//! Volumes and lengths in space, and areas in the plane.

use std::f64::consts::PI;

use glam::DVec3;

use crate::sphere::volume;

/// Number of dimensions of a packing, 2 or 3.
#[derive(Debug, Clone, Copy)]
pub(super) struct Dimensions(pub u32);

impl Dimensions {
    /// The number itself.
    pub fn number(self) -> f64 {
        f64::from(self.0)
    }

    /// Volume of a sphere of a radius \[m\], or area of a disc.
    pub fn of_sphere(self, radius: f64) -> f64 {
        match self.0 {
            2 => PI * radius * radius,
            _ => volume(radius),
        }
    }

    /// Volume of a box with these edges \[m\], or area of a rectangle.
    pub fn of_box(self, size: DVec3) -> f64 {
        match self.0 {
            2 => size.x * size.y,
            _ => size.element_product(),
        }
    }

    /// Length of the edge of a cube of this volume, or of a square of this area.
    pub fn edge(self, content: f64) -> f64 {
        match self.0 {
            2 => content.sqrt(),
            _ => libm::cbrt(content),
        }
    }

    /// Part of a vector in the space of the packing: in two dimensions without z.
    pub fn project(self, vector: DVec3) -> DVec3 {
        match self.0 {
            2 => vector.with_z(0.0),
            _ => vector,
        }
    }
}
