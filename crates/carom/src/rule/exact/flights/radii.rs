//! Radii of spheres that grow, as flights need them.

use glam::DVec3;

use super::species::Species;
use super::state::Flights;
use crate::norm::Norm;

impl Flights {
    /// Radius of a sphere at `time` \[s\], in metres.
    #[inline]
    pub fn radius_at(&self, slot: u32, time: f64) -> f64 {
        let species = self.species_of(slot);
        self.growth.map_or(species.radius, |growth| growth.radius_at(species, time))
    }

    /// Factor of the contact distance of two species: they touch where their centres are this many times the sum of
    /// their radii apart.
    #[inline]
    pub fn distance_factor(&self, species: [&Species; 2]) -> f64 {
        if self.non_additivity.is_none() {
            return 1.0;
        }
        self.non_additivity.factor(species.map(|it| it.material))
    }

    /// Radii of two species \[m\], multiplied by the factor of their contact distance.
    #[inline]
    pub fn contact_radii(&self, species: [&Species; 2]) -> [f64; 2] {
        let factor = self.distance_factor(species);
        species.map(|it| factor * it.radius)
    }

    /// Distance of the centres of two species in contact \[m\].
    #[inline]
    pub fn contact_distance(&self, species: [&Species; 2]) -> f64 {
        let [first, second] = self.contact_radii(species);
        first + second
    }

    /// Radius for which neighbour lists are made for a species \[m\]: with growth, wells or contact distances larger
    /// than the sums of radii, that of its reach.
    #[inline]
    pub fn largest_radius(&self, species: &Species) -> f64 {
        if let Some(wells) = &self.wells {
            return wells.range_ratio * species.radius;
        }
        let radius =
            self.growth.map_or(species.radius, |growth| growth.radius_at(species, growth.until));
        self.non_additivity.reach(species.material) * radius
    }

    /// Sets for how long neighbour lists made at `time` \[s\] are valid, in a periodic box with these edges \[m\].
    pub fn make_room_to_grow(&mut self, time: f64, period: DVec3) {
        if let Some(growth) = &mut self.growth {
            let reach = self.non_additivity.largest();
            growth.until = growth.room_ends(&self.species, time, period / reach);
        }
    }

    /// Whether growth made a sphere so fast that it has no room left.
    pub fn is_overheated(&self, slot: u32) -> bool {
        let speed = self.bodies[slot as usize].velocity.norm();
        self.growth.is_some_and(|growth| speed > growth.speed_limit)
    }

    /// Returns the time until which the neighbour lists are wide enough for growing radii, on the
    /// world's clock \[s\].
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
