//! Spheres in flight since their last event.

use glam::DVec3;

use super::species::Species;
use crate::flight::Flight;

/// One sphere in flight: all that a prediction reads of it, in one line of cache.
///
/// Only an event of its own writes it, so where the sphere is follows from this alone, however many
/// frames have passed since.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(C, align(64))]
pub(crate) struct Body {
    /// Centre at `time` \[m\]. In a periodic box it is not wrapped during a flight.
    pub position: DVec3,
    /// Velocity at `time` \[m/s\].
    pub velocity: DVec3,
    /// Start of the flight, on the world's clock \[s\].
    pub time: f64,
    /// The number of its species.
    pub species: u32,
    /// Grows whenever the sphere's flight restarts, so that a prediction made with another generation is void. Odd
    /// if an impact began the flight.
    pub generation: u32,
}

impl Body {
    /// The flight from its start, whose own time is 0 there.
    #[inline]
    pub fn flight(&self, species: &Species) -> Flight {
        Flight {
            position: self.position,
            velocity: self.velocity,
            acceleration: species.acceleration,
            drag_rate: species.drag_rate,
        }
    }

    /// Centre \[m\] and velocity \[m/s\] at `time` \[s\].
    #[inline]
    pub fn state_at(&self, species: &Species, time: f64) -> (DVec3, DVec3) {
        self.flight(species).after(time - self.time)
    }

    /// The flight from `time` \[s\] on.
    pub fn flight_from(&self, species: &Species, time: f64) -> Flight {
        let (position, velocity) = self.state_at(species, time);
        Flight { position, velocity, ..self.flight(species) }
    }

    /// Ends the flight and begins another from this state, at `time` \[s\].
    pub fn begin_flight(&mut self, position: DVec3, velocity: DVec3, time: f64) {
        (self.position, self.velocity, self.time) = (position, velocity, time);
        self.generation = (self.generation | 1).wrapping_add(1);
    }

    /// Marks the flight as one that an impact began.
    pub fn strike(&mut self) {
        self.generation |= 1;
    }

    /// Whether an impact began the flight.
    #[inline(always)]
    pub fn is_struck(&self) -> bool {
        self.generation & 1 == 1
    }
}
