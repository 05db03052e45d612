//! Lengths of vectors.

use glam::DVec3;

/// A vector that has a length.
pub(crate) trait Norm {
    /// `|v|`, by the processor's own square root.
    ///
    /// It has the bits of glam's `length`, which calls `libm` here. In WebAssembly `libm` computes square roots in
    /// integers, which took a sixth of the time of a frame.
    fn norm(self) -> f64;
}

impl Norm for DVec3 {
    fn norm(self) -> f64 {
        self.length_squared().sqrt()
    }
}
