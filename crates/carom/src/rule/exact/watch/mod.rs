//! The watch over spheres: the flights along which sensors look and work is counted.

pub(crate) mod force_work;
pub(crate) mod look_along;
pub(crate) mod seen;
mod watched_spring;

use self::force_work::ForceTally;
use self::seen::Seen;
use crate::force_work::ForceWork;
use crate::sensor::{Presence, Sensors};

/// The current flight of each sphere, and the results along earlier flights.
#[derive(Debug, Clone, Default)]
pub(crate) struct Watch {
    /// Results of sensors; `None` without sensors.
    pub sensors: Option<Sensors>,
    /// Work of forces; `None` where none has to be counted.
    pub(crate) tally: Option<ForceTally>,
    /// Flights as seen, by index.
    pub(crate) flights: Vec<Seen>,
    /// Slots of spheres that began a flight since.
    pub(crate) begun: Vec<u32>,
    /// Start of the step, on the world's clock \[s\].
    pub(crate) step_start: f64,
}

impl Watch {
    /// Creates a watch over a step that starts at a time \[s\]: for sensors if their contents are given, and for the
    /// work of forces if `measures_work`.
    pub fn new(presence: Option<Presence>, measures_work: bool, step_start: f64) -> Self {
        let sensors = presence.map(Sensors::with);
        let tally = measures_work.then(ForceTally::default);
        Self { sensors, tally, step_start, ..Self::default() }
    }

    /// Returns the work since the last call.
    pub fn take_work(&mut self) -> ForceWork {
        self.tally.as_mut().map(|tally| std::mem::take(&mut tally.work)).unwrap_or_default()
    }
}
