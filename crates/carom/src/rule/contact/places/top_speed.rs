//! How fast a collider moves at most.

use glam::DVec3;

/// How fast the surfaces of a collider move at most within the frame.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TopSpeed {
    /// Speed of the origin \[m/s\].
    pub speed: f64,
    /// \[rad/s\]
    pub spin: f64,
    /// Origin at the start of the sub-step \[m\].
    pub origin: DVec3,
}

impl TopSpeed {
    /// Speed \[m/s\] of surfaces up to a distance `beside` \[m\] from a place \[m\], within a time \[s\].
    pub fn around(&self, place: DVec3, beside: f64, time: f64) -> f64 {
        let arm = (place - self.origin).length() + beside;
        self.speed + self.spin * (arm + self.speed * time)
    }
}
