//! Axis-aligned bounds.

use glam::DVec3;

/// Axis-aligned bounds \[m\].
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Bounds {
    pub min: DVec3,
    pub max: DVec3,
}

impl Bounds {
    pub fn around(center: DVec3, half: DVec3) -> Self {
        Self { min: center - half, max: center + half }
    }

    /// The middle \[m\].
    pub fn center(&self) -> DVec3 {
        0.5 * (self.min + self.max)
    }

    /// Half of the lengths along the axes \[m\].
    pub fn half(&self) -> DVec3 {
        0.5 * (self.max - self.min)
    }

    /// The bounds, wider by `margin` \[m\] on all sides.
    pub fn widened(&self, margin: f64) -> Self {
        Self { min: self.min - margin, max: self.max + margin }
    }

    /// The bounds, moved by `shift` \[m\].
    pub fn moved(&self, shift: DVec3) -> Self {
        Self { min: self.min + shift, max: self.max + shift }
    }

    #[inline]
    pub fn overlap(&self, other: &Self) -> bool {
        // All comparisons at once: the processor cannot predict which one fails.
        let along =
            |axis: usize| (self.min[axis] <= other.max[axis]) & (other.min[axis] <= self.max[axis]);
        along(0) & along(1) & along(2)
    }

    /// A lower bound of the distance of a point from what is within them \[m\].
    pub fn distance_below(&self, point: DVec3) -> f64 {
        let outside = (self.min - point).max(point - self.max).max(DVec3::ZERO);
        // Less than rounding may add.
        outside.dot(outside).sqrt() * (1.0 - 1e-12)
    }

    pub fn union(self, other: Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// Half of the area of the box \[m²\].
    pub fn half_area(&self) -> f64 {
        let DVec3 { x, y, z } = self.max - self.min;
        x * y + y * z + z * x
    }
}
