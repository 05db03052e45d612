use glam::DVec3;

use crate::bodies::Motion;

/// Where one sphere is and how it moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Kinematics {
    /// Centre \[m\].
    pub position: DVec3,
    /// Velocity \[m/s\].
    pub velocity: DVec3,
}

impl Kinematics {
    /// Returns the motion of the sphere at an index.
    pub fn of(motion: &Motion, index: usize) -> Self {
        Self { position: motion.position[index], velocity: motion.velocity[index] }
    }

    /// Makes it that of the sphere at an index.
    pub fn write(self, motion: &mut Motion, index: usize) {
        (motion.position[index], motion.velocity[index]) = (self.position, self.velocity);
    }
}
