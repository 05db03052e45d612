//! One step of an integrator as the flight of a sphere.

use educe::Educe;
use glam::DVec3;

use crate::integrate::gauss_radau::Pace;
use crate::polynomial_flight::{ORDERS, PolynomialAcceleration, TERMS, scaled, shifted};

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
    /// What its persistent contacts do, where it has some.
    pub held: Option<Box<HeldCurve>>,
}

/// What the persistent contacts of a sphere do over a step.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct HeldCurve {
    /// The acceleration without them \[m/s²\].
    pub free: PolynomialAcceleration,
    /// Power of moving surfaces on the sphere \[W\]: the coefficients of a polynomial over the same time.
    pub collider_power: [f64; TERMS],
}

impl HeldCurve {
    /// The rest from a time \[s\] on.
    pub fn from(&self, time: f64) -> Self {
        let length = self.free.length;
        let rest = shifted(self.collider_power, time / length);
        let collider_power = scaled(rest, (length - time) / length);
        Self { free: self.free.from(time), collider_power }
    }

    /// Work of moving surfaces between two times \[s\], \[J\].
    pub fn collider_work(&self, times: [f64; 2]) -> f64 {
        let [before, after] = times.map(|time| {
            let s = time / self.free.length;
            let terms = self.collider_power.iter().zip(ORDERS).rev();
            s * terms.fold(0.0, |sum, (c, k)| sum * s + c / (k + 1.0))
        });
        self.free.length * (after - before)
    }
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
            step.held = None;
        }
    }
}
