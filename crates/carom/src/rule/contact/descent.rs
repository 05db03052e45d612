//! What is kept while sweeps are accelerated.

/// What a slab keeps of the descent \[N s\], of pairs and then of surfaces; empty otherwise.
#[derive(Debug, Clone, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Descent {
    /// The normal impulses before the sweeps.
    pub before: Vec<f64>,
    /// What the sweeps changed.
    pub change: Vec<f64>,
    /// The direction that is followed.
    pub direction: Vec<f64>,
}
