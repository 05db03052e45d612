//! Work of a run, by stage.

use carom::StageCounts;
use serde::{Deserialize, Serialize};

/// Work of a run by stage, as in JSON: counts, or counts per impact. [`StageCounts`] explains them.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct StageWork<T> {
    pub predictions: T,
    pub pair_tests: T,
    pub events: T,
    pub cell_crossings: T,
    pub groups: T,
    pub solver_iterations: T,
    pub searches: T,
    pub sweeps: T,
    pub contacts: T,
}

impl From<StageCounts> for StageWork<u64> {
    fn from(counts: StageCounts) -> Self {
        Self {
            predictions: counts.predictions,
            pair_tests: counts.pair_tests,
            events: counts.events,
            cell_crossings: counts.cell_crossings,
            groups: counts.groups,
            solver_iterations: counts.solver_iterations,
            searches: counts.searches,
            sweeps: counts.sweeps,
            contacts: counts.contacts,
        }
    }
}

impl StageWork<f64> {
    /// Divides counts by the number of impacts; `None` without impacts.
    pub fn per_impact(counts: StageCounts, impacts: u64) -> Option<Self> {
        let per_impact = |count: u64| count as f64 / impacts as f64;
        (impacts > 0).then(|| Self {
            predictions: per_impact(counts.predictions),
            pair_tests: per_impact(counts.pair_tests),
            events: per_impact(counts.events),
            cell_crossings: per_impact(counts.cell_crossings),
            groups: per_impact(counts.groups),
            solver_iterations: per_impact(counts.solver_iterations),
            searches: per_impact(counts.searches),
            sweeps: per_impact(counts.sweeps),
            contacts: per_impact(counts.contacts),
        })
    }
}
