//! Sums and maxima of a stage over one slab.

/// Sums and maxima of a stage over one slab, to be combined in the order of slabs.
#[derive(Debug, Clone, Copy, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct SlabTotals {
    /// A sum \[J\].
    pub energy: f64,
    /// Work of impulses \[J\].
    pub work: f64,
    /// Largest change of a normal impulse \[N s\], or of a velocity \[m/s\].
    pub change: f64,
    /// Largest speed that a contact had to stop \[m/s\]; in the last sweep, by how much it still closed too fast.
    pub excess: f64,
    /// Largest normal impulse, before or after a sweep \[N s\].
    pub impulse: f64,
    /// Largest overlap, as a part of the sum of radii.
    pub overlap: f64,
    /// Number of spheres pressed into a surface as far as allowed.
    pub squeezed: u32,
    /// Whether a sphere may leave its margin.
    pub leaves: bool,
}

impl SlabTotals {
    /// The largest change of an impulse, as a part of the largest impulse.
    pub fn residual(&self) -> f64 {
        if self.impulse > 0.0 { self.change / self.impulse } else { 0.0 }
    }

    /// The larger changes, excesses and impulses of two parts.
    pub fn or_larger(self, other: Self) -> Self {
        let change = self.change.max(other.change);
        let excess = self.excess.max(other.excess);
        Self { change, excess, impulse: self.impulse.max(other.impulse), ..self }
    }
}
