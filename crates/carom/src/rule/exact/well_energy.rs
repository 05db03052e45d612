//! Potential energy of the pairs that are inside wells.

use super::flights::Wells;
use super::timeline::Timeline;
use crate::detect::instant::Instant;

impl Timeline {
    /// Potential energy of the bound pairs \[J\].
    pub fn well_energy(&self) -> f64 {
        self.flights.wells.as_ref().map_or(0.0, Wells::energy)
    }
}

/// Potential energy \[J\] of the pairs whose distances are inside their wells.
pub(crate) fn well_energy(now: &Instant) -> f64 {
    Wells::of(now).map_or(0.0, |wells| wells.energy())
}
