//! Errors of recordings.

use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

/// Why a recording failed.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RecordingError {
    /// The ending of the file name belongs to no format.
    #[error("{path} has no known format: use {known}", known = ENDINGS)]
    UnknownFormat {
        /// Path of the file.
        path: PathBuf,
    },
    /// The format has no columns for further numbers.
    #[error("{path} has no columns for further numbers: use .csv")]
    NoFurtherColumns {
        /// Path of the file.
        path: PathBuf,
    },
    /// The file cannot be written.
    #[error("cannot write {path}: {source}")]
    Unwritable {
        /// Path of the file.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
}

const ENDINGS: &str =
    ".csv, .npz, .pvd (a series of .vtp files for ParaView), .xyz (extended), .lammpstrj, or .gsd";

/// Converts an error of writing to `path`.
pub(super) fn unwritable(path: &Path, source: io::Error) -> RecordingError {
    let of_table = source.get_ref().and_then(|it| it.downcast_ref::<csv::Error>());
    let source = match of_table.map(csv::Error::kind) {
        // The csv writer wraps the error and hides its kind; restore it.
        Some(csv::ErrorKind::Io(inner)) => io::Error::new(inner.kind(), inner.to_string()),
        _ => source,
    };
    RecordingError::Unwritable { path: path.to_owned(), source }
}
