//! Why a recording fails.

use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

/// Why a recording failed.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RecordingError {
    /// The ending of the file name names no format.
    #[error("cannot tell the format of {path}: use {known}", known = ENDINGS)]
    UnknownFormat {
        /// The file.
        path: PathBuf,
    },
    /// The file cannot be written.
    #[error("cannot write {path}: {source}")]
    Unwritable {
        /// The file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
}

const ENDINGS: &str = ".csv, .npz, or .pvd (a series of .vtp files for ParaView)";

/// The place cannot be written to.
pub(super) fn unwritable(path: &Path, source: io::Error) -> RecordingError {
    let of_table = source.get_ref().and_then(|it| it.downcast_ref::<csv::Error>());
    let source = match of_table.map(csv::Error::kind) {
        // The kind of an error is lost where a table passes it on.
        Some(csv::ErrorKind::Io(inner)) => io::Error::new(inner.kind(), inner.to_string()),
        _ => source,
    };
    RecordingError::Unwritable { path: path.to_owned(), source }
}
