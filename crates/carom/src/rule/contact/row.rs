//! Four numbers that are read together.

use glam::DVec3;

/// A vector and one number more, in one piece of memory that a vector of the processor holds.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[repr(align(32))]
pub(super) struct Row(pub [f64; 4]);

impl Row {
    #[inline(always)]
    pub fn new(vector: DVec3, number: f64) -> Self {
        Self([vector.x, vector.y, vector.z, number])
    }

    #[inline(always)]
    pub fn vector(self) -> DVec3 {
        let [x, y, z, _] = self.0;
        DVec3::new(x, y, z)
    }

    /// The number beside the vector.
    #[inline(always)]
    pub fn number(self) -> f64 {
        self.0[3]
    }

    /// The same number beside another vector.
    #[inline(always)]
    pub fn with_vector(self, vector: DVec3) -> Self {
        Self::new(vector, self.0[3])
    }
}
