//! Impacts as CSV: one row per impact.

use std::io;
use std::path::{Path, PathBuf};

use carom::{BodyPair, Impact};

use super::error::{RecordingError, unwritable};
use super::table_file::{TableFile, digits, headed};

/// Columns: time \[s\]; kind and number of body 1 (`sphere` or `collider`) and number of body 2, a
/// sphere; point \[m\]; normal from 1 to 2; approach speed \[m/s\]; impulse along the normal, and of friction
/// across it, on body 2 \[N s\].
pub(super) const HEADER: [&str; 15] = [
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
    "impulse",
    "tangential_x",
    "tangential_y",
    "tangential_z",
];

/// Writes impacts to a CSV file.
#[derive(Debug)]
pub struct ImpactTable {
    path: PathBuf,
    writer: csv::Writer<TableFile>,
}

impl ImpactTable {
    /// Creates the file.
    ///
    /// # Errors
    /// For a place that cannot be written to.
    pub fn create(path: &Path) -> Result<Self, RecordingError> {
        let file = TableFile::create(path).map_err(|source| unwritable(path, source))?;
        Self::of(file, path)
    }

    /// Writes CSV to `out`, which errors call `name`.
    ///
    /// # Errors
    /// If it takes nothing.
    pub fn csv(out: impl io::Write + Send + 'static, name: &str) -> Result<Self, RecordingError> {
        Self::of(TableFile::new(Box::new(out)), Path::new(name))
    }

    fn of(file: TableFile, path: &Path) -> Result<Self, RecordingError> {
        let writer = headed(file, &HEADER).map_err(|source| unwritable(path, source))?;
        Ok(Self { path: path.to_owned(), writer })
    }

    /// Writes the impacts of a step that started at `start` \[s\].
    ///
    /// # Errors
    /// If the disk is full or gone.
    pub fn write(&mut self, start: f64, impacts: &[Impact]) -> Result<(), RecordingError> {
        let result = impacts.iter().try_for_each(|impact| self.write_row(start, impact));
        let result = result.and_then(|()| self.flush(!impacts.is_empty()));
        result.map_err(|source| unwritable(&self.path, source))
    }

    fn flush(&mut self, has_rows: bool) -> io::Result<()> {
        if has_rows { self.writer.flush() } else { Ok(()) }
    }

    fn write_row(&mut self, start: f64, impact: &Impact) -> io::Result<()> {
        let fields = impact_fields(start, impact);
        let along_normal = [impact.approach_speed, impact.impulse];
        let numbers = along_normal.into_iter().chain(impact.tangential_impulse.to_array());
        self.writer.write_record(fields.into_iter().chain(numbers.map(digits)))?;
        Ok(())
    }

    /// Completes the file.
    ///
    /// # Errors
    /// If the disk is full or gone.
    pub fn finish(mut self) -> Result<(), RecordingError> {
        self.writer.flush().map_err(|source| unwritable(&self.path, source))
    }
}

/// The bodies of an impact, when and where: the first columns of a row, as in [`HEADER`].
pub(super) fn impact_fields(start: f64, impact: &Impact) -> Vec<String> {
    let (kind, body1, ball2) = match impact.between {
        BodyPair::Spheres(first, second) => ("sphere", first.number(), second.number()),
        BodyPair::Collider { collider, sphere } => ("collider", collider.number(), sphere.number()),
    };
    let mut fields =
        vec![digits(start + impact.time), kind.to_owned(), body1.to_string(), ball2.to_string()];
    let places = [impact.point, impact.normal];
    fields.extend(places.iter().flat_map(|place| place.to_array()).map(digits));
    fields
}
