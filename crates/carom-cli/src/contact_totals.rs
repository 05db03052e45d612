//! What the rule `contact` did to energy in a run, and how good its solutions are.

use carom::{ContactAccount, StepReport};
use serde::Serialize;

/// The accounts of all frames of a run under the rule `contact`, as JSON has them.
#[derive(Debug, Clone, Copy, Default, Serialize)]
pub struct ContactTotals {
    /// What impulses of contacts did to kinetic energy \[J\], summed: impacts and friction take.
    impulse_work: f64,
    /// Work of moving colliders \[J\], summed.
    surface_work: f64,
    /// Energy that the correction of overlaps added \[J\], summed.
    correction_work: f64,
    /// Sub-steps in which impulses were scaled down for them not to add energy, summed.
    limited_sub_steps: u64,
    /// Change of a normal impulse in the last sweep, as a part of the largest; the largest of all.
    residual: f64,
    /// Overlap before it was corrected, as a part of the sum of radii; the largest of all.
    largest_overlap: f64,
}

impl ContactTotals {
    /// Takes in what a step reports.
    pub fn add(&mut self, report: &StepReport) {
        let ContactAccount {
            impulse_work,
            surface_work,
            correction_work,
            limited_sub_steps,
            residual,
            largest_overlap,
            ..
        } = report.contact_account;
        self.impulse_work += impulse_work;
        self.surface_work += surface_work;
        self.correction_work += correction_work;
        self.limited_sub_steps += u64::from(limited_sub_steps);
        self.residual = self.residual.max(residual);
        self.largest_overlap = self.largest_overlap.max(largest_overlap);
    }

    /// The lines of a summary; of a part of the spheres, that are `stepped`, or of all.
    pub fn rows(&self, stepped: bool) -> Vec<(&'static str, String)> {
        let part = if stepped { " of stepped zones" } else { "" };
        let Self { correction_work, surface_work, residual, largest_overlap, .. } = self;
        let mut added = format!("{correction_work:.3e} J by correction of overlaps");
        if *surface_work != 0.0 {
            added += &format!(", {surface_work:.3e} J by moving colliders");
        }
        vec![
            (
                "energy taken",
                format!("{:.3e} J by impacts and friction{part}", 0.0 - self.impulse_work),
            ),
            ("energy added", added),
            (
                "overlap",
                format!("{largest_overlap:.1e} of the sum of radii at most, then corrected"),
            ),
            ("residual", format!("{residual:.1e} of the largest impulse at most")),
        ]
    }
}
