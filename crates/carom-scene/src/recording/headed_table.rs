//! CSV files with a fixed header.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use super::error::{RecordingError, unwritable};
use super::table_file::TableFile;

/// Writes rows below a header to a CSV file.
#[derive(Debug)]
pub(super) struct HeadedTable {
    path: PathBuf,
    writer: csv::Writer<TableFile>,
}

impl HeadedTable {
    /// Creates the file.
    pub fn create(path: &Path, header: &[&str]) -> Result<Self, RecordingError> {
        let file = TableFile::create(path).map_err(|source| unwritable(path, source))?;
        Self::of(file, path, header)
    }

    /// Writes to `out`; errors call it `name`.
    pub fn new(
        out: impl Write + Send + 'static,
        name: &str,
        header: &[&str],
    ) -> Result<Self, RecordingError> {
        Self::of(TableFile::new(Box::new(out)), Path::new(name), header)
    }

    fn of(file: TableFile, path: &Path, header: &[&str]) -> Result<Self, RecordingError> {
        let writer = csv::Writer::from_writer(file);
        let mut table = Self { path: path.to_owned(), writer };
        table.write(header)?;
        table.flush()?;
        Ok(table)
    }

    /// Writes a row.
    pub fn write(
        &mut self,
        fields: impl IntoIterator<Item = impl AsRef<[u8]>>,
    ) -> Result<(), RecordingError> {
        let written = self.writer.write_record(fields).map_err(io::Error::from);
        written.map_err(|source| unwritable(&self.path, source))
    }

    /// Passes all rows to the operating system.
    pub fn flush(&mut self) -> Result<(), RecordingError> {
        self.writer.flush().map_err(|source| unwritable(&self.path, source))
    }
}
