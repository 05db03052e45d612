//! Meetings that spheres pass over, for there is nothing to answer in them.

use super::flights::Flights;
use crate::detect::contact::Bodies;

/// Two bodies that touch, and for how long a meeting of them has nothing to answer.
///
/// Two bodies that hardly touch may meet, by the rounding of one formula, and have nothing to
/// answer, by that of another.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Unresolved {
    pub bodies: Bodies,
    /// On the world's clock \[s\].
    pub until: f64,
}

/// What a sphere passes over in its flight.
#[derive(Debug, Clone)]
pub(crate) struct Passage {
    /// By index.
    pub sphere: u32,
    /// Of its flight.
    pub generation: u32,
    pub meetings: Vec<Unresolved>,
    /// When another flight begins, on the world's clock \[s\].
    pub restart: f64,
}

impl Passage {
    /// Whether the sphere is still in that flight `now` \[s\], and not at its end.
    pub fn lasts(&self, flights: &Flights, now: f64) -> bool {
        let slot = flights.slot_of[self.sphere as usize];
        flights.bodies[slot as usize].generation == self.generation && self.restart > now
    }
}
