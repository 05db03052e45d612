//! How good the solutions of the rule `contact` were in a run.

use carom::{ContactAccount, StepReport};
use serde::Serialize;

/// The accounts of all frames of a run under the rule `contact`, as JSON has them.
#[derive(Debug, Clone, Copy, Default, Serialize)]
pub struct ContactTotals {
    /// Sub-steps in which impulses were scaled down for them not to add energy, summed.
    limited_sub_steps: u64,
    /// Change of a normal impulse in the last sweep, as a part of the largest; the largest of all.
    residual: f64,
    /// Overlap before it was corrected, as a part of the sum of radii; the largest of all.
    largest_overlap: f64,
    /// How often a ball was pressed into a surface by half its radius, in each sub-step; summed.
    pub squeezed: u64,
}

impl ContactTotals {
    /// Takes in what a step reports.
    pub fn add(&mut self, report: &StepReport) {
        let ContactAccount { limited_sub_steps, residual, largest_overlap, squeezed, .. } =
            report.contact_account;
        self.limited_sub_steps += u64::from(limited_sub_steps);
        self.residual = self.residual.max(residual);
        self.largest_overlap = self.largest_overlap.max(largest_overlap);
        self.squeezed += u64::from(squeezed);
    }

    /// The lines of a summary.
    pub fn rows(&self) -> Vec<(&'static str, String)> {
        let Self { residual, largest_overlap, .. } = self;
        vec![
            (
                "overlap",
                format!("{largest_overlap:.1e} of the sum of radii at most, then corrected"),
            ),
            (
                "residual",
                format!(
                    "{residual:.1e}: the last sweep changes an impulse by that part of the largest"
                ),
            ),
        ]
    }
}
