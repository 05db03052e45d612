//! Files to which tables are written.

use std::fmt;
use std::fs::{File, OpenOptions};
use std::io::{self, Write};
use std::path::Path;

use crate::unfinished::create_folders_of;
#[cfg(unix)]
use crate::unfinished::lock;

/// A writer that keeps only whole rows. Each flush marks the end of whole rows; after an error, the
/// file is cut there, and later bytes are discarded without an error.
pub(super) struct TableFile {
    out: Box<dyn Write + Send>,
    /// The same file, if it can be cut.
    file: Option<File>,
    position: u64,
    /// End of the last whole row.
    whole: u64,
    has_failed: bool,
}

impl TableFile {
    /// Opens or creates a file, with missing folders above it.
    pub fn create(path: &Path) -> io::Result<Self> {
        create_folders_of(path)?;
        // The old content stays until the lock shows that no other run writes the file.
        let file = OpenOptions::new().write(true).create(true).truncate(false).open(path)?;
        // Pipes and devices have neither a lock nor a length.
        if file.metadata()?.is_file() {
            // On other systems, a locked file could not be read while it grows.
            #[cfg(unix)]
            lock(&file)?;
            file.set_len(0)?;
        }
        let same = file.try_clone()?;
        Ok(Self { file: Some(same), ..Self::new(Box::new(file)) })
    }

    pub fn new(out: Box<dyn Write + Send>) -> Self {
        Self { out, file: None, position: 0, whole: 0, has_failed: false }
    }

    fn noting<T>(&mut self, result: io::Result<T>) -> io::Result<T> {
        if result.is_err() && !self.has_failed {
            self.has_failed = true;
            if let Some(file) = &self.file {
                // A device cannot be cut.
                file.set_len(self.whole).ok();
            }
        }
        result
    }
}

impl fmt::Debug for TableFile {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("TableFile").field("position", &self.position).finish_non_exhaustive()
    }
}

impl Write for TableFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if self.has_failed {
            return Ok(bytes.len());
        }
        let written = self.out.write(bytes);
        if written.as_ref().is_err_and(|error| error.kind() == io::ErrorKind::Interrupted) {
            return written;
        }
        let written = self.noting(written)?;
        self.position += written as u64;
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        if self.has_failed {
            return Ok(());
        }
        let flushed = self.out.flush();
        self.noting(flushed)?;
        self.whole = self.position;
        Ok(())
    }
}

/// Writes a number with 17 significant digits, which distinguish any two doubles.
pub(super) fn digits(value: f64) -> String {
    format!("{value:.16e}")
}

#[cfg(test)]
#[cfg(unix)]
mod tests {
    use super::*;

    #[test]
    fn a_table_that_another_run_writes_is_refused_and_stays_as_it_is() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("t.csv");
        let mut first = TableFile::create(&path).unwrap();
        first.write_all(b"t,ball\n").unwrap();
        first.flush().unwrap();
        let refused = TableFile::create(&path).unwrap_err();
        assert_eq!(refused.to_string(), "a program is still writing it");
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "t,ball\n");
        drop(first);
        TableFile::create(&path).unwrap();
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "");
    }

    #[test]
    fn missing_folders_of_a_table_are_made() {
        let folder = tempfile::tempdir().unwrap();
        TableFile::create(&folder.path().join("of/runs/t.csv")).unwrap();
        assert!(folder.path().join("of/runs/t.csv").is_file());
    }

    #[test]
    fn a_device_is_written_as_it_is() {
        let mut file = TableFile::create(Path::new("/dev/null")).unwrap();
        file.write_all(b"t,ball\n").unwrap();
        file.flush().unwrap();
    }
}
