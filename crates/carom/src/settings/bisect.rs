use super::Integrator;
use crate::error::InvalidValue;
use crate::validate;

/// Parameters of the rule `bisect`.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Bisect {
    /// The scheme that moves spheres over a frame, and over the pieces into which contacts cut it.
    pub integrator: Integrator,
    /// Surfaces at most this far apart, or overlapping by at most this, touch \[m\].
    pub tolerance: f64,
    /// Halvings of the (rest of the) frame in search of a contact; the error in its time is at
    /// most the frame divided by two to this power.
    pub max_halvings: u32,
    /// How often two bodies may meet in a frame. Bodies at rest on each other would meet without
    /// end; at the bound, their group takes the rest of the frame in one piece.
    pub max_impacts: u32,
    /// Which spheres go through the pieces into which a contact cuts the frame.
    pub wind_back: WindBack,
}

impl Default for Bisect {
    fn default() -> Self {
        Self {
            integrator: Integrator::default(),
            // Far above rounding in a scene of metres, far below anything one could see.
            tolerance: 1e-9,
            max_halvings: 8,
            max_impacts: 32,
            wind_back: WindBack::Touched,
        }
    }
}

impl Bisect {
    /// Returns the parameters with this integrator.
    pub fn with_integrator(self, integrator: Integrator) -> Self {
        Self { integrator, ..self }
    }

    /// Returns the parameters with this touching distance \[m\].
    pub fn with_tolerance(self, tolerance: f64) -> Self {
        Self { tolerance, ..self }
    }

    /// Returns the parameters with this many halvings at most.
    pub fn with_max_halvings(self, max_halvings: u32) -> Self {
        Self { max_halvings, ..self }
    }

    /// Returns the parameters with this many impacts of two bodies in a frame at most.
    pub fn with_max_impacts(self, max_impacts: u32) -> Self {
        Self { max_impacts, ..self }
    }

    /// Returns the parameters with these spheres wound back.
    pub fn with_wind_back(self, wind_back: WindBack) -> Self {
        Self { wind_back, ..self }
    }

    pub(super) fn validate(&self) -> Result<(), InvalidValue> {
        validate::non_negative("tolerance", self.tolerance)?;
        validate::at_least_one("max_halvings", self.max_halvings)?;
        validate::at_least_one("max_impacts", self.max_impacts)
    }
}

/// Which spheres go through the pieces into which a contact cuts the frame.
///
/// The choice is between two errors of the integrator's order; without forces they agree.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum WindBack {
    /// Spheres that take part in a contact of the same group. The others take the frame in one
    /// piece, undisturbed by impacts elsewhere, and the work is proportional to the contacts.
    #[default]
    Touched,
    /// All, as the tutorial does. The work grows with spheres times contacts.
    All,
}
