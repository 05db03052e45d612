//! Radii of spheres that grow, as flights need them.

use glam::DVec3;

use super::species::Species;
use super::state::Flights;
use crate::norm::Norm;

/// In a step, growth makes no sphere faster than this many times the fastest sphere at the start, or the fastest
/// radius. Spheres without room are struck ever more often and ever harder, and the step would not end.
const MOST_HEATED: f64 = 4096.0;

impl Flights {
    /// Radius of a sphere at `time` \[s\], in metres.
    #[inline]
    pub fn radius_at(&self, slot: u32, time: f64) -> f64 {
        let species = self.species_of(slot);
        self.growth.map_or(species.radius, |growth| growth.radius_at(species, time))
    }

    /// Radius for which neighbour lists are made for a species \[m\]: with growth or wells, that of its reach.
    #[inline]
    pub fn largest_radius(&self, species: &Species) -> f64 {
        if let Some(wells) = &self.wells {
            return wells.range_ratio * species.radius;
        }
        self.growth.map_or(species.radius, |growth| growth.radius_at(species, growth.until))
    }

    /// Sets for how long neighbour lists made at `time` \[s\] are valid, in a periodic box with these edges \[m\].
    pub fn make_room_to_grow(&mut self, time: f64, period: DVec3) {
        if let Some(growth) = &mut self.growth {
            growth.until = growth.room_ends(&self.species, time, period);
        }
    }

    /// Limits how fast spheres become in a step that begins now.
    pub fn limit_heating(&mut self) {
        let Self { growth: Some(growth), bodies, species, .. } = self else { return };
        let speeds = bodies.iter().map(|body| body.velocity.norm());
        let growth_speeds = species.iter().map(|species| species.growth_speed);
        growth.speed_limit = MOST_HEATED * speeds.chain(growth_speeds).fold(0.0, f64::max);
    }

    /// Whether growth made a sphere faster than the step allows.
    pub fn is_overheated(&self, slot: u32) -> bool {
        let speed = self.bodies[slot as usize].velocity.norm();
        self.growth.is_some_and(|growth| speed > growth.speed_limit)
    }

    /// Until when the neighbour lists are wide enough for growing radii, on the world's clock \[s\].
    #[inline]
    pub fn room_until(&self) -> f64 {
        self.growth.map_or(f64::INFINITY, |growth| growth.until)
    }

    /// Writes the radii of all spheres at `time` \[s\] if some grow, in metres.
    pub fn write_radii(&self, radii: &mut [f64], time: f64) {
        if self.growth.is_some() {
            for (radius, &slot) in radii.iter_mut().zip(&self.slot_of) {
                *radius = self.radius_at(slot, time);
            }
        }
    }
}
