//! Records the events of square wells as CSV: one row per event.

use std::io;
use std::path::Path;

use carom::WellEvent;

use super::error::RecordingError;
use super::headed_table::HeadedTable;
use super::table_file::digits;

/// Columns: time \[s\]; `capture`, `dissociation` or `bounce`; numbers of the two spheres; unit vector from the first
/// to the second; distance of their centres \[m\]; impulse that drives them apart \[N s\].
const HEADER: [&str; 9] = ["t", "event", "ball1", "ball2", "nx", "ny", "nz", "distance", "impulse"];

/// Writes the events of square wells to a CSV file.
#[derive(Debug)]
pub struct WellTable(HeadedTable);

impl WellTable {
    /// Creates the file.
    ///
    /// # Errors
    /// [`RecordingError`] if the file cannot be written.
    pub fn create(path: &Path) -> Result<Self, RecordingError> {
        HeadedTable::create(path, &HEADER).map(Self)
    }

    /// Writes CSV to `out`; errors call it `name`.
    ///
    /// # Errors
    /// [`RecordingError`] if `out` cannot be written to.
    pub fn csv(out: impl io::Write + Send + 'static, name: &str) -> Result<Self, RecordingError> {
        HeadedTable::new(out, name, &HEADER).map(Self)
    }

    /// Writes the events of a step that started at `start` \[s\].
    ///
    /// # Errors
    /// [`RecordingError`] if the disk is full or gone.
    pub fn write(&mut self, start: f64, events: &[WellEvent]) -> Result<(), RecordingError> {
        events.iter().try_for_each(|event| self.0.write(fields(start, event)))?;
        if events.is_empty() { Ok(()) } else { self.0.flush() }
    }

    /// Completes the file.
    ///
    /// # Errors
    /// [`RecordingError`] if the disk is full or gone.
    pub fn finish(mut self) -> Result<(), RecordingError> {
        self.0.flush()
    }
}

fn fields(start: f64, event: &WellEvent) -> Vec<String> {
    let mut fields = vec![digits(start + event.time), event.kind.to_string()];
    fields.extend(event.between.map(|sphere| sphere.number().to_string()));
    fields.extend(event.normal.to_array().map(digits));
    fields.extend([event.distance, event.impulse].map(digits));
    fields
}
