use glam::DVec3;

/// Where one sphere is and how it moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Kinematics {
    /// Centre \[m\].
    pub position: DVec3,
    /// Velocity \[m/s\].
    pub velocity: DVec3,
}
