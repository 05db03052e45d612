//! Quality of the solutions of the rule `contact` over a run.

use carom::{ContactAccount, StepReport};
use serde::Serialize;

/// Totals over all frames of a run under the rule `contact`, as in JSON.
#[derive(Debug, Clone, Copy, Default, Serialize)]
pub struct ContactTotals {
    /// Number of sub-steps in which impulses were scaled down so as not to add energy.
    limited_sub_steps: u64,
    /// Largest change of a normal impulse in a last sweep, relative to the largest impulse.
    residual: f64,
    /// Largest overlap before correction, as a fraction of the sum of radii.
    largest_overlap: f64,
    /// How often a ball was pressed into a surface by half its radius, summed over sub-steps.
    pub squeezed: u64,
}

impl ContactTotals {
    /// Adds the report of a step.
    pub fn add(&mut self, report: &StepReport) {
        let ContactAccount { limited_sub_steps, residual, largest_overlap, squeezed, .. } =
            report.contact_account;
        self.limited_sub_steps += u64::from(limited_sub_steps);
        self.residual = self.residual.max(residual);
        self.largest_overlap = self.largest_overlap.max(largest_overlap);
        self.squeezed += u64::from(squeezed);
    }

    /// Lines of the summary.
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
