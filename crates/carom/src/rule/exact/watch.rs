//! The watch over sensors: the flight of each sphere up to which sensors have looked.

use crate::flight::Flight;
use crate::polynomial_flight::PolynomialFlight;
use crate::sensor::{Presence, Sensors};

/// The flight of each sphere that sensors look along next, and what they saw before.
#[derive(Debug, Clone, Default)]
pub(crate) struct Watch {
    pub sensors: Sensors,
    /// By index.
    pub(super) flights: Vec<Seen>,
    /// Slots of spheres that began a flight since.
    pub(super) begun: Vec<u32>,
    /// Start of the step, on the world's clock \[s\].
    pub(super) step_start: f64,
}

/// A flight that sensors look along.
#[derive(Debug, Clone, Copy)]
pub(super) struct Seen {
    pub flight: Flight,
    pub curve: Option<PolynomialFlight>,
    pub flight_start: f64,
    pub generation: u32,
    /// Up to when sensors have looked along the flight, on the world's clock \[s\].
    pub from: f64,
}

impl Watch {
    /// A watch over a step that starts at a time \[s\].
    pub fn new(presence: Presence, step_start: f64) -> Self {
        Self { sensors: Sensors::with(presence), step_start, ..Self::default() }
    }
}
