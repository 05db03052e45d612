//! Boxes along the axes around what is drawn.

use carom::{DVec3, Pose, Shape};
use carom_scene::outline::half_lengths;

/// A box along the axes \[m\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// Lower corner of the box.
    pub min: DVec3,
    /// Upper corner of the box.
    pub max: DVec3,
}

impl Bounds {
    /// The box around a sphere of radius 1 at the origin; used for an empty scene.
    pub const UNIT: Self = Self { min: DVec3::NEG_ONE, max: DVec3::ONE };

    /// Returns the box that holds a single point \[m\].
    pub fn at(point: DVec3) -> Self {
        Self { min: point, max: point }
    }

    /// Returns the box around a sphere.
    pub fn from_sphere(center: DVec3, radius: f64) -> Self {
        Self { min: center - radius, max: center + radius }
    }

    /// Returns the box around a shape at `pose`; `None` for a shape without end.
    pub fn of_shape(shape: Shape, pose: Pose) -> Option<Self> {
        let mut middle = DVec3::ZERO;
        let half = match shape {
            Shape::Sphere { radius } => return Some(Self::from_sphere(pose.position, radius)),
            Shape::Rectangle { size_x, size_z } => 0.5 * DVec3::new(size_x, 0.0, size_z),
            Shape::Box { size } | Shape::Container { size, .. } => 0.5 * size,
            Shape::Mesh(mesh) => {
                let [min, max] = mesh.bounds();
                middle = 0.5 * (min + max);
                0.5 * (max - min)
            }
            ref other => half_lengths(other)?,
        };
        let rotation = pose.rotation.normalize();
        let reach = (rotation * (DVec3::X * half.x)).abs()
            + (rotation * (DVec3::Y * half.y)).abs()
            + (rotation * (DVec3::Z * half.z)).abs();
        let middle = pose.position + rotation * middle;
        Some(Self { min: middle - reach, max: middle + reach })
    }

    /// Returns the box around all of these boxes; `None` if there are none.
    pub fn around(all: impl IntoIterator<Item = Self>) -> Option<Self> {
        all.into_iter().reduce(Self::with)
    }

    /// Returns the box around both boxes.
    pub fn with(self, other: Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// Returns the box moved outward by `by` on every side \[m\].
    pub fn grown(self, by: f64) -> Self {
        Self { min: self.min - by, max: self.max + by }
    }

    /// Returns whether `other` lies within this box.
    pub fn holds(&self, other: &Self) -> bool {
        self.min.cmple(other.min).all() && other.max.cmple(self.max).all()
    }

    /// Returns the middle of the box.
    pub fn center(&self) -> DVec3 {
        0.5 * (self.min + self.max)
    }

    /// Returns half of the diagonal \[m\].
    pub fn radius(&self) -> f64 {
        0.5 * (self.max - self.min).length()
    }

    /// Returns the eight corners.
    pub fn corners(&self) -> [DVec3; 8] {
        std::array::from_fn(|i| {
            let pick = |axis: usize| {
                if i >> axis & 1 == 0 { self.min[axis] } else { self.max[axis] }
            };
            DVec3::new(pick(0), pick(1), pick(2))
        })
    }
}
