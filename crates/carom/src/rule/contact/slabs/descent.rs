//! State of accelerated sweeps.

use educe::Educe;

/// The descent of a slab \[N s\], of pairs and then of surfaces; empty without one.
#[derive(Debug, Educe, Default)]
#[educe(Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Descent {
    /// The normal impulses before the sweeps.
    pub before: Vec<f64>,
    /// Change by the sweeps.
    pub change: Vec<f64>,
    /// The direction that is followed.
    pub direction: Vec<f64>,
}
