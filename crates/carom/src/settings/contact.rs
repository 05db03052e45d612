use crate::error::InvalidValue;
use crate::validate;

/// Parameters of the rule `contact`.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Contact {
    /// Sub-steps of a frame, at least 1; more are taken where spheres are small or surfaces turn fast. Overlaps
    /// fall with the square of the length of sub-steps.
    pub sub_steps: u32,
    /// Sweeps over all contacts in a sub-step, at least 1.
    pub sweeps: u32,
    /// Whether sweeps continue until the residual is at most 1e-10: slow, for comparison.
    pub converged: bool,
    /// Speed below which a sphere with pressing contacts counts as at rest and may fall asleep, as a part of
    /// `sqrt(a r)`, the speed after falling through half its radius r, >= 0. With 0 no sphere sleeps.
    pub sleep_speed: f64,
}

impl Default for Contact {
    fn default() -> Self {
        Self { sub_steps: 8, sweeps: 2, converged: false, sleep_speed: 0.02 }
    }
}

impl Contact {
    /// Returns the parameters with this number of sub-steps in a frame.
    pub fn with_sub_steps(self, sub_steps: u32) -> Self {
        Self { sub_steps, ..self }
    }

    /// Returns the parameters with this number of sweeps in a sub-step.
    pub fn with_sweeps(self, sweeps: u32) -> Self {
        Self { sweeps, ..self }
    }

    /// Returns the parameters, with or without sweeps until the solution has converged.
    pub fn with_converged(self, converged: bool) -> Self {
        Self { converged, ..self }
    }

    /// Returns the parameters with another speed of sleep, as a part of `sqrt(a r)`; 0 for none.
    pub fn with_sleep_speed(self, sleep_speed: f64) -> Self {
        Self { sleep_speed, ..self }
    }

    pub(super) fn validate(&self) -> Result<(), InvalidValue> {
        validate::at_least_one("sub_steps", self.sub_steps)?;
        validate::at_least_one("sweeps", self.sweeps)?;
        validate::non_negative("sleep_speed", self.sleep_speed)
    }
}
