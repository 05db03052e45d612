//! Work of nonconservative forces: of those whose potential energy does not account for all of it.

use std::ops::AddAssign;

/// Work of nonconservative forces \[J\].
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct ForceWork {
    /// Work of forces on all spheres, and of the dampers of springs.
    pub forces: f64,
    /// Work of forces applied to single spheres.
    pub applied: f64,
    /// Work of steady shear on the motion relative to the mean flow.
    pub shear: f64,
    /// What held forces did beyond what the forces themselves would have done along the same flights.
    pub integration: f64,
}

impl AddAssign for ForceWork {
    fn add_assign(&mut self, other: Self) {
        self.forces += other.forces;
        self.applied += other.applied;
        self.shear += other.shear;
        self.integration += other.integration;
    }
}
