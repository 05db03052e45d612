//! Boxes around what is drawn.

use carom::{DVec3, Pose, Shape};

/// A box along the axes \[m\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// Its lower corner.
    pub min: DVec3,
    /// Its upper corner.
    pub max: DVec3,
}

impl Bounds {
    /// Around a sphere of radius 1 at the origin: for where there is nothing to see.
    pub const UNIT: Self = Self { min: DVec3::NEG_ONE, max: DVec3::ONE };

    /// A single point \[m\].
    pub fn at(point: DVec3) -> Self {
        Self { min: point, max: point }
    }

    /// The box around a sphere.
    pub fn of_sphere(center: DVec3, radius: f64) -> Self {
        Self { min: center - radius, max: center + radius }
    }

    /// The box around a shape in this place; `None` for one that has no end.
    pub fn of_shape(shape: Shape, pose: Pose) -> Option<Self> {
        let half = match shape {
            Shape::Sphere { radius } => return Some(Self::of_sphere(pose.position, radius)),
            Shape::Rectangle { size_x, size_z } => 0.5 * DVec3::new(size_x, 0.0, size_z),
            Shape::Box { size } | Shape::Container { size, .. } => 0.5 * size,
            _ => return None,
        };
        let rotation = pose.rotation.normalize();
        let reach = (rotation * (DVec3::X * half.x)).abs()
            + (rotation * (DVec3::Y * half.y)).abs()
            + (rotation * (DVec3::Z * half.z)).abs();
        Some(Self { min: pose.position - reach, max: pose.position + reach })
    }

    /// The box around all of these; `None` without any.
    pub fn around(all: impl IntoIterator<Item = Self>) -> Option<Self> {
        all.into_iter().reduce(Self::with)
    }

    /// The box around both.
    pub fn with(self, other: Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// The box that reaches farther by this on every side \[m\].
    pub fn grown(self, by: f64) -> Self {
        Self { min: self.min - by, max: self.max + by }
    }

    /// Whether another box lies within it.
    pub fn holds(&self, other: &Self) -> bool {
        self.min.cmple(other.min).all() && other.max.cmple(self.max).all()
    }

    /// Its middle.
    pub fn center(&self) -> DVec3 {
        0.5 * (self.min + self.max)
    }

    /// Half of its diagonal.
    pub fn radius(&self) -> f64 {
        0.5 * (self.max - self.min).length()
    }

    /// Its eight corners.
    pub fn corners(&self) -> [DVec3; 8] {
        std::array::from_fn(|i| {
            let pick = |axis: usize| {
                if i >> axis & 1 == 0 { self.min[axis] } else { self.max[axis] }
            };
            DVec3::new(pick(0), pick(1), pick(2))
        })
    }
}
