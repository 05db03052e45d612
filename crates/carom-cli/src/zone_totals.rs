//! What was stepped under the rule `exact` in a run.

use carom::{StepReport, ZoneAccount};
use serde::Serialize;

/// The accounts of the stepped zones of all frames of a run, as JSON has them.
#[derive(Debug, Clone, Copy, Default, Serialize)]
pub struct ZoneTotals {
    /// Spheres in zones at the end of a frame; the largest number of all.
    most_spheres: u32,
    /// And at the end of the last frame.
    spheres: u32,
    /// Time that spheres spent in zones \[s\], of all together.
    sphere_seconds: f64,
    /// Ticks at which zones were stepped.
    ticks: u64,
    /// Spheres that came into a zone.
    joined: u64,
    /// Spheres that left one.
    left: u64,
}

impl ZoneTotals {
    /// Takes in what a step reports.
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

    /// The line of a summary of a run over so many seconds.
    pub fn row(&self, time: f64) -> String {
        let Self { most_spheres, spheres, sphere_seconds, .. } = self;
        let mean = sphere_seconds / time;
        format!(
            "{mean:.1} spheres in the mean, {most_spheres} at most, {spheres} at the end: not exact"
        )
    }
}
