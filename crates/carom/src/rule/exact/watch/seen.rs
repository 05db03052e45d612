//! The flight of a sphere, as the watch has seen it.

use glam::DVec3;

use crate::flight::Flight;
use crate::polynomial_flight::PolynomialFlight;

/// A flight that sensors look along.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Seen {
    pub flight: Flight,
    pub curve: Option<PolynomialFlight>,
    pub flight_start: f64,
    pub generation: u32,
    /// Whether the sphere is in a zone.
    pub is_stepped: bool,
    /// Forces of nonconservative interactions, held over the flight \[N\].
    pub working_force: DVec3,
    /// The other forces that are held over the flight \[N\]: conservative ones, dampers, and in persistent contacts
    /// also others that are not linear. `None` where the flight follows the forces as they change.
    pub held_force: Option<DVec3>,
    /// Time up to which the watch has looked along the flight, on the world's clock \[s\].
    pub from: f64,
}

impl Seen {
    /// Centre \[m\] and velocity \[m/s\] at a time on the world's clock \[s\].
    pub fn state_at(&self, time: f64) -> (DVec3, DVec3) {
        let age = time - self.flight_start;
        match &self.curve {
            Some(curve) => curve.after(age),
            None => self.flight.after(age),
        }
    }
}
