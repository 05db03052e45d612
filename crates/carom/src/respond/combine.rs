//! Coefficients of a contact, from those of its bodies.

use crate::settings::CombineRule;

impl CombineRule {
    /// The coefficient of a contact between bodies of coefficients `e1` and `e2`.
    pub fn combine(self, e1: f64, e2: f64) -> f64 {
        match self {
            Self::Product => e1 * e2,
            Self::Minimum => e1.min(e2),
            Self::Maximum => e1.max(e2),
            Self::Average => 0.5 * (e1 + e2),
            Self::GeometricMean => (e1 * e2).sqrt(),
        }
    }
}
