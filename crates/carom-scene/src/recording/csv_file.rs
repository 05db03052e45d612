//! Tables as CSV files.

use std::fs::File;
use std::io;
use std::path::Path;

/// Creates a CSV file with this header.
pub(super) fn csv_file(path: &Path, header: &[&str]) -> io::Result<csv::Writer<File>> {
    let mut writer = csv::Writer::from_writer(File::create(path)?);
    writer.write_record(header)?;
    Ok(writer)
}

/// A number with 17 significant digits: as many as tell any two doubles apart.
pub(super) fn digits(value: f64) -> String {
    format!("{value:.16e}")
}
