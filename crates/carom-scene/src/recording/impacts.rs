//! Records impacts as CSV or NPZ: one row per impact.

use std::io;
use std::path::{Path, PathBuf};

use carom::{BodyPair, Impact};

use super::error::{RecordingError, unwritable};
use super::headed_table::HeadedTable;
use super::impact_arrays::ImpactArrays;
use super::table_file::digits;

/// Columns: time \[s\]; kind (`sphere` or `collider`) and number of body 1, and number of body 2, a
/// sphere; point \[m\]; normal from 1 to 2; approach speed \[m/s\]; normal impulse and tangential
/// impulse on body 2 \[N s\].
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

/// Writes impacts to a CSV or an NPZ file.
#[derive(Debug)]
pub struct ImpactTable(Table);

#[derive(Debug)]
enum Table {
    Csv(Box<HeadedTable>),
    Arrays(PathBuf, ImpactArrays),
}

impl ImpactTable {
    /// Creates the file: NPZ for the ending `.npz`, CSV for any other one.
    ///
    /// # Errors
    /// [`RecordingError`] if the file cannot be written.
    pub fn create(path: &Path) -> Result<Self, RecordingError> {
        let is_archive = path.extension().is_some_and(|it| it.eq_ignore_ascii_case("npz"));
        if !is_archive {
            return HeadedTable::create(path, &HEADER)
                .map(|table| Self(Table::Csv(Box::new(table))));
        }
        let arrays = ImpactArrays::create(path).map_err(|source| unwritable(path, source))?;
        Ok(Self(Table::Arrays(path.to_owned(), arrays)))
    }

    /// Writes CSV to `out`; errors call it `name`.
    ///
    /// # Errors
    /// [`RecordingError`] if `out` cannot be written to.
    pub fn csv(out: impl io::Write + Send + 'static, name: &str) -> Result<Self, RecordingError> {
        HeadedTable::new(out, name, &HEADER).map(|table| Self(Table::Csv(Box::new(table))))
    }

    /// Writes the impacts of a step that started at `start` \[s\].
    ///
    /// # Errors
    /// [`RecordingError`] if the disk is full or gone.
    pub fn write(&mut self, start: f64, impacts: &[Impact]) -> Result<(), RecordingError> {
        match &mut self.0 {
            Table::Csv(_) if impacts.is_empty() => Ok(()),
            Table::Csv(table) => {
                impacts.iter().try_for_each(|impact| table.write(fields(start, impact)))?;
                table.flush()
            }
            Table::Arrays(path, arrays) => {
                arrays.write(start, impacts).map_err(|source| unwritable(path, source))
            }
        }
    }

    /// Completes the file. Before that, an NPZ archive does not exist yet, but [`recover`](super::recover) creates it
    /// after a crash.
    ///
    /// # Errors
    /// [`RecordingError`] if the disk is full or gone.
    pub fn finish(self) -> Result<(), RecordingError> {
        match self.0 {
            Table::Csv(mut table) => table.flush(),
            Table::Arrays(path, arrays) => {
                arrays.finish().map_err(|source| unwritable(&path, source))
            }
        }
    }
}

fn fields(start: f64, impact: &Impact) -> Vec<String> {
    let mut fields = impact_fields(start, impact);
    fields.extend([impact.approach_speed, impact.impulse].map(digits));
    fields.extend(impact.tangential_impulse.to_array().map(digits));
    fields
}

/// First columns of a row, as in [`HEADER`]: time, bodies, point and normal of an impact.
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
