//! Spheres that wait for the first tick of their zone.

use glam::DVec3;

use super::changes::Changes;
use crate::id::SphereId;

/// A sphere that joined a zone and waits for its first tick.
#[derive(Debug, Clone, Copy)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Waiting {
    pub sphere: SphereId,
    /// When it joined, on the world's clock \[s\].
    pub since: f64,
    /// Velocity of the sphere then and at the tick \[m/s\].
    pub velocities: [DVec3; 2],
    /// Forces that have a potential, as they act on it until the tick \[N\].
    pub force: DVec3,
    /// Changes of energy until the tick.
    pub changes: Changes,
}

impl Waiting {
    /// The part of the way from its joining to the next tick \[s\] that is over at a time \[s\], 0 to 1.
    pub fn part(&self, time: f64, next: f64) -> f64 {
        let part = if next > self.since { (time - self.since) / (next - self.since) } else { 1.0 };
        part.clamp(0.0, 1.0)
    }
}
