//! Completes unfinished recordings.

use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

use crate::unfinished::Unfinished;

/// What was recovered from an unfinished recording.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Recovered {
    /// Number of frames.
    pub frames: u64,
    /// Time of the last frame \[s\]; `None` without a frame.
    pub last: Option<f64>,
    /// Number of bytes after the last complete frame, which are lost.
    pub left_out: u64,
    /// Whether those bytes are damaged, for example by a failing disk, as opposed to a frame that
    /// was cut short. If they are, the unfinished file is kept.
    pub is_damaged: bool,
}

/// Why a recording cannot be recovered.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RecoveryError {
    /// The file cannot be read, or is still being written.
    #[error("cannot recover {path}: {source}")]
    Unreadable {
        /// Path of the file.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
    /// The file was not left by a run.
    #[error("{path} is no unfinished recording")]
    Foreign {
        /// Path of the file.
        path: PathBuf,
    },
    /// The file has no complete frame.
    #[error("{path} has no whole frame")]
    Empty {
        /// Path of the file.
        path: PathBuf,
    },
    /// The file is no table that a run writes.
    #[error("{path} is no table of a run: its first line names other columns")]
    ForeignTable {
        /// Path of the file.
        path: PathBuf,
    },
    /// The complete file cannot be written.
    #[error("cannot write {path}: {source}")]
    Unwritable {
        /// Path of the complete file.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
}

/// Creates the complete file `target` from the file `unfinished` of a killed run. Removes
/// `unfinished` unless part of it is damaged. `close` reads `unfinished` and writes `target`; it
/// returns `None` if `unfinished` is of another kind.
///
/// # Errors
/// [`RecoveryError`]. Both files are then unchanged, except if only the removal of `unfinished`
/// failed.
pub fn recover_by(
    unfinished: &Path,
    target: &Path,
    close: impl FnOnce(&mut File, File) -> io::Result<Option<Recovered>>,
) -> Result<Recovered, RecoveryError> {
    let unreadable = |source| RecoveryError::Unreadable { path: unfinished.to_owned(), source };
    let mut file = Unfinished::open(unfinished, target).map_err(unreadable)?;
    let closed = file.close(|source, target| close(source, target)?.ok_or(NotMade::Foreign));
    let recovered = closed.map_err(|error| match error {
        NotMade::Foreign => RecoveryError::Foreign { path: unfinished.to_owned() },
        // The content is invalid.
        NotMade::Unwritable(source) if source.kind() == io::ErrorKind::InvalidData => {
            unreadable(source)
        }
        NotMade::Unwritable(source) => {
            RecoveryError::Unwritable { path: target.to_owned(), source }
        }
    })?;
    if !recovered.is_damaged {
        file.remove().map_err(unreadable)?;
    }
    Ok(recovered)
}

/// Creates the complete file from an unfinished one, which must contain `frames` frames, and
/// removes the unfinished one. `close` is as in [`recover_by`].
///
/// # Errors
/// [`io::Error`] if `close` or the disk fails, or the number of frames differs. The unfinished file
/// is then kept, and the error contains its path.
pub fn complete(
    mut unfinished: Unfinished,
    frames: u64,
    close: impl FnOnce(&mut File, File) -> io::Result<Option<Recovered>>,
) -> io::Result<()> {
    let changed = || io::Error::new(io::ErrorKind::InvalidData, "its frames have changed");
    let closed = unfinished.close(|source, target| {
        close(source, target)?.filter(|it| it.frames == frames).ok_or_else(changed)
    });
    match (closed, unfinished.place()) {
        (Ok(_), _) => unfinished.remove(),
        (Err(error), Some(place)) => {
            let place = place.display();
            let kept = format!("{error}; its frames are in {place}, for `carom recover`");
            Err(io::Error::new(error.kind(), kept))
        }
        (Err(error), None) => Err(error),
    }
}

/// Why a complete file was not created.
enum NotMade {
    /// The unfinished file is of another kind.
    Foreign,
    Unwritable(io::Error),
}

impl From<io::Error> for NotMade {
    fn from(error: io::Error) -> Self {
        Self::Unwritable(error)
    }
}
