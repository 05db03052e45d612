//! Work of forces that no potential accounts for.

use std::ops::AddAssign;

/// Work of forces that no potential accounts for \[J\].
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct ForceWork {
    /// Of forces on all spheres, and of the dampers of springs.
    pub forces: f64,
    /// Of forces applied to single spheres.
    pub applied: f64,
}

impl AddAssign for ForceWork {
    fn add_assign(&mut self, other: Self) {
        self.forces += other.forces;
        self.applied += other.applied;
    }
}
