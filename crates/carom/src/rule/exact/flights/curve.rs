//! One step of an integrator as the flight of a sphere.

use educe::Educe;
use glam::DVec3;

use crate::integrate::gauss_radau::Pace;
use crate::polynomial_flight::PolynomialAcceleration;

/// A step's polynomial predicts the start of the next step only up to this many times its own length.
const LONGEST_GUESS: f64 = 64.0;

/// One step of the flight of a sphere.
#[derive(Debug, Educe, Default)]
#[educe(Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Curve(pub(super) Option<Box<CurveStep>>);

#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct CurveStep {
    /// Generation of the flight that follows this step.
    pub generation: u32,
    pub acceleration: PolynomialAcceleration,
    /// When it ends, on the world's clock \[s\].
    pub end: f64,
    /// Whether forces stay smooth at the end; else a spring changes how it acts there.
    pub is_smooth: bool,
    /// Estimate for the next step.
    pub pace: Pace,
    /// Parts of the position \[m\] and of the velocity \[m/s\] at its end below their rounding.
    pub left: [DVec3; 2],
    /// The acceleration without persistent contacts, where the sphere has some \[m/s²\].
    pub free: Option<Box<PolynomialAcceleration>>,
}

impl CurveStep {
    /// Whether the polynomial is a good first guess for a step that begins at a time \[s\].
    pub fn leads_to(&self, time: f64) -> bool {
        let is_long = self.pace.trial <= LONGEST_GUESS * self.acceleration.length;
        self.end == time && self.is_smooth && is_long
    }
}

impl Curve {
    /// Returns a curve that has not begun, with steps like those of this one.
    pub fn to_begin(&self) -> Self {
        let mut curve = self.clone();
        curve.end();
        curve
    }

    /// Ends the flight. The next one has steps like this one.
    pub fn end(&mut self) {
        if let Some(step) = &mut self.0 {
            // No flight has this generation: those that events begin are even, those that impacts begin are one more.
            step.generation = u32::MAX;
            step.free = None;
        }
    }
}
