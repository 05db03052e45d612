//! Boxes around what is drawn.

use carom::DVec3;

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

    /// The box around a sphere.
    pub fn of_sphere(center: DVec3, radius: f64) -> Self {
        Self { min: center - radius, max: center + radius }
    }

    /// The box around all of these; `None` without any.
    pub fn around(all: impl IntoIterator<Item = Self>) -> Option<Self> {
        all.into_iter().reduce(Self::with)
    }

    /// The box around both.
    pub fn with(self, other: Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
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
