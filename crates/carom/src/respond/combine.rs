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

    /// The derivatives of [`Self::combine`] by both coefficients. Where both are the same, the smaller and the larger one
    /// is the first.
    pub(crate) fn derivatives(self, [e1, e2]: [f64; 2]) -> [f64; 2] {
        let chosen = |is_first| if is_first { [1.0, 0.0] } else { [0.0, 1.0] };
        match self {
            Self::Product => [e2, e1],
            Self::Minimum => chosen(e1 <= e2),
            Self::Maximum => chosen(e1 >= e2),
            Self::Average => [0.5, 0.5],
            Self::GeometricMean => {
                let mean = (e1 * e2).sqrt();
                [0.5 * mean / e1, 0.5 * mean / e2]
            }
        }
    }
}
