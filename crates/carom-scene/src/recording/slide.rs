//! How far a sheared box has slid.

use carom::{Boundary, Settings};

/// Returns the way along x by which the box above, along y, is beside a box in steady shear at a time \[m\]: at most
/// half an edge. `None` without shear.
pub fn slide(settings: &Settings, time: f64) -> Option<f64> {
    let Settings { boundary: Boundary::Periodic { size }, shear_rate, .. } = *settings else {
        return None;
    };
    // The remainder is exact, and so is what is left of it.
    let rest = libm::fmod(shear_rate * size.y * time, size.x);
    (shear_rate != 0.0).then(|| rest - (rest / size.x).round() * size.x)
}
