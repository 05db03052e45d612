//! Lengths of vectors.

use glam::DVec3;

/// A vector that has a length.
pub(crate) trait Norm {
    /// `|v|`, by the processor's own square root.
    ///
    /// The same bits as glam's `length`. That calls `libm`, as all of glam does here; but in
    /// WebAssembly `libm` works square roots out in whole numbers: a sixth of the time of a frame.
    fn norm(self) -> f64;
}

impl Norm for DVec3 {
    fn norm(self) -> f64 {
        self.length_squared().sqrt()
    }
}
