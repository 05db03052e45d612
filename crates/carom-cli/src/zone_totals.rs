//! Stepped zones of the rule `exact` over a run.

use carom::{StepReport, ZoneAccount};
use serde::Serialize;

/// Totals of the stepped zones over all frames of a run, as in JSON.
#[derive(Debug, Clone, Copy, Default, Serialize)]
pub struct ZoneTotals {
    /// Largest number of spheres in zones at the end of a frame.
    most_spheres: u32,
    /// Number of spheres in zones at the end of the run.
    spheres: u32,
    /// Time that spheres spent in zones, summed over spheres \[s\].
    sphere_seconds: f64,
    /// Number of ticks at which zones were stepped.
    ticks: u64,
    /// Number of spheres that joined a zone.
    joined: u64,
    /// Number of spheres that left a zone.
    left: u64,
}

impl ZoneTotals {
    /// Adds the report of a step.
    pub fn add(&mut self, report: &StepReport) {
        let ZoneAccount { spheres, sphere_seconds, ticks, joined, left, .. } = report.zone_account;
        self.most_spheres = self.most_spheres.max(spheres);
        self.spheres = spheres;
        self.sphere_seconds += sphere_seconds;
        self.ticks += u64::from(ticks);
        self.joined += u64::from(joined);
        self.left += u64::from(left);
    }

    /// Whether any sphere was stepped.
    pub fn are_any(&self) -> bool {
        self.joined > 0
    }

    /// Line of the summary of a run that lasted `time` \[s\].
    pub fn row(&self, time: f64) -> String {
        let Self { most_spheres, spheres, sphere_seconds, .. } = self;
        let mean = sphere_seconds / time;
        format!(
            "{mean:.1} spheres in the mean, {most_spheres} at most, {spheres} at the end: not exact"
        )
    }
}
