//! One step of an integrator as the flight of a sphere.

use crate::integrate::gauss_radau::Pace;
use crate::polynomial_flight::PolynomialAcceleration;

/// A step tells nothing of what follows for more than so many times its length.
const LONGEST_GUESS: f64 = 64.0;

/// One step of the flight of a sphere.
#[derive(Debug, Clone, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Curve(pub(super) Option<CurveStep>);

#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct CurveStep {
    /// Generation of the flight that it is.
    pub generation: u32,
    pub acceleration: PolynomialAcceleration,
    /// When it ends, on the world's clock \[s\].
    pub end: f64,
    /// Whether forces go on there as they are; else a spring changes how it acts.
    pub is_smooth: bool,
    /// What is to be expected of the step after it.
    pub pace: Pace,
}

impl CurveStep {
    /// Whether what follows at a time \[s\] is likely to go on as the step does.
    pub fn leads_to(&self, time: f64) -> bool {
        let is_long = self.pace.trial <= LONGEST_GUESS * self.acceleration.length;
        self.end == time && self.is_smooth && is_long
    }
}

impl Curve {
    /// One whose flight has yet to begin, by steps as those of this one.
    pub fn to_begin(&self) -> Self {
        // No flight is of this generation: those that an event begins are even, those of impacts one more.
        let step = self.0.clone().map(|step| CurveStep { generation: u32::MAX, ..step });
        Self(step)
    }
}
