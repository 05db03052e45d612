//! Growth: radii that change at steady speeds while spheres fly.

use glam::DVec3;

use super::species::Species;
use crate::norm::Norm;

/// Neighbour lists are made for radii larger by this part. A larger part makes wider cells with more spheres in
/// them, a smaller one more searches for neighbours.
const ROOM_TO_GROW: f64 = 1.0 / 16.0;

/// Growth makes no sphere faster than this many times the fastest sphere at its start, or the fastest radius. A gas
/// without a thermostat reaches some fifty times at a packing fraction of 0.62. Spheres without room are struck ever
/// more often and ever harder, without an end.
const MOST_HEATED: f64 = 256.0;

/// The growth of radii: when it began, and until when the neighbour lists are valid.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Growth {
    /// When the radii were those of the species, on the world's clock \[s\].
    pub since: f64,
    /// Time until which the neighbour lists are wide enough, on the world's clock \[s\].
    pub until: f64,
    /// Largest speed that growth may give a sphere \[m/s\].
    pub speed_limit: f64,
}

impl Growth {
    /// The growth of spheres that have the radii of their species, and these velocities \[m/s\], at `time` \[s\];
    /// `None` if none grows.
    pub fn of(
        species: &[Species],
        velocities: impl Iterator<Item = DVec3>,
        time: f64,
    ) -> Option<Self> {
        let growth_speed = species.iter().map(|it| it.growth_speed).fold(0.0, f64::max);
        let fastest = velocities.map(Norm::norm).fold(growth_speed, f64::max);
        let speed_limit = MOST_HEATED * fastest;
        (growth_speed > 0.0).then_some(Self { since: time, until: time, speed_limit })
    }

    /// Radius of spheres of a species at `time` \[s\], in metres.
    #[inline]
    pub fn radius_at(&self, species: &Species, time: f64) -> f64 {
        species.radius + species.growth_speed * (time - self.since)
    }

    /// When a radius has outgrown the neighbour lists made at `time` \[s\], or a periodic box with these edges
    /// \[m\] holds no larger sphere.
    pub fn room_ends(&self, species: &[Species], time: f64, period: DVec3) -> f64 {
        let largest = 0.25 * period.min_element();
        let mut end = f64::INFINITY;
        for it in species.iter().filter(|it| it.growth_speed > 0.0) {
            let doubtful = time + ROOM_TO_GROW * self.radius_at(it, time) / it.growth_speed;
            let full = self.since + (largest - it.radius) / it.growth_speed;
            end = end.min(if full > time { doubtful.min(full) } else { doubtful });
        }
        end.max(time.next_up())
    }
}
