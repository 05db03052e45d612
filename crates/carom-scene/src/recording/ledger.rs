//! Records the ledger as CSV: one row per impact, with momentum and energy of its group.

use std::io;
use std::path::Path;

use carom::{LedgerEntry, StepReport};

use super::error::RecordingError;
use super::headed_table::HeadedTable;
use super::impacts::impact_fields;
use super::table_file::digits;

/// Columns: those of the impacts up to the normal; approach and separation speed \[m/s\]; normal
/// impulse and tangential impulse \[N s\]; impact law; number of the group in the run, and number
/// of its impacts; momentum of the group before and after, without the contribution of colliders
/// \[kg m/s\]; its kinetic energy before, after (without the work of moving colliders), and the
/// change that restitution requires \[J\].
pub(super) const HEADER: [&str; 28] = [
    "t",
    "kind1",
    "body1",
    "ball2",
    "x",
    "y",
    "z",
    "nx",
    "ny",
    "nz",
    "approach_speed",
    "separation_speed",
    "impulse",
    "tangential_x",
    "tangential_y",
    "tangential_z",
    "law",
    "group",
    "group_size",
    "px_before",
    "py_before",
    "pz_before",
    "px_after",
    "py_after",
    "pz_after",
    "energy_before",
    "energy_after",
    "energy_demanded",
];

/// Writes the ledger of a run to a CSV file.
#[derive(Debug)]
pub struct LedgerTable {
    table: HeadedTable,
    /// Number of groups in the steps written so far.
    groups: usize,
}

impl LedgerTable {
    /// Creates the file.
    ///
    /// # Errors
    /// [`RecordingError`] if the file cannot be written.
    pub fn create(path: &Path) -> Result<Self, RecordingError> {
        Ok(Self { table: HeadedTable::create(path, &HEADER)?, groups: 0 })
    }

    /// Writes CSV to `out`; errors call it `name`.
    ///
    /// # Errors
    /// [`RecordingError`] if `out` cannot be written to.
    pub fn csv(out: impl io::Write + Send + 'static, name: &str) -> Result<Self, RecordingError> {
        Ok(Self { table: HeadedTable::new(out, name, &HEADER)?, groups: 0 })
    }

    /// Writes the impacts of a step that started at `start` \[s\].
    ///
    /// # Errors
    /// [`RecordingError`] if the disk is full or gone.
    pub fn write(&mut self, start: f64, report: &StepReport) -> Result<(), RecordingError> {
        for entry in report.ledger() {
            let group =
                self.groups + report.groups.partition_point(|it| it.first < entry.group.first);
            self.table.write(fields(start, entry, group))?;
        }
        self.groups += report.groups.len();
        if report.groups.is_empty() { Ok(()) } else { self.table.flush() }
    }

    /// Completes the file.
    ///
    /// # Errors
    /// [`RecordingError`] if the disk is full or gone.
    pub fn finish(mut self) -> Result<(), RecordingError> {
        self.table.flush()
    }
}

fn fields(start: f64, LedgerEntry { impact, group }: LedgerEntry, number: usize) -> Vec<String> {
    let mut fields = impact_fields(start, impact);
    fields.extend([impact.approach_speed, impact.separation_speed, impact.impulse].map(digits));
    fields.extend(impact.tangential_impulse.to_array().map(digits));
    fields.extend([group.law.to_string(), number.to_string(), group.count.to_string()]);
    let momenta = [group.momentum_before, group.momentum_after];
    fields.extend(momenta.iter().flat_map(|momentum| momentum.to_array()).map(digits));
    let energies = [group.energy_before, group.energy_after, group.energy_demanded];
    fields.extend(energies.map(digits));
    fields
}
