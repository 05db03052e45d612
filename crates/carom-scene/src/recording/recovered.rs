//! Complete files of unfinished ones.

use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

use crate::unfinished::Unfinished;

/// What was recovered of a recording.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Recovered {
    /// Frames.
    pub frames: u64,
    /// Time of the last one \[s\]; `None` without a frame.
    pub last: Option<f64>,
    /// Bytes after the last whole frame, which are left out.
    pub left_out: u64,
    /// Whether these are no frame that was cut short, but something else, like what a failing disk leaves. Then the
    /// unfinished file stays.
    pub is_damaged: bool,
}

/// Why a recording cannot be recovered.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RecoveryError {
    /// The file cannot be read, or is still being written.
    #[error("cannot recover {path}: {source}")]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// The file is none that a run left.
    #[error("{path} is no unfinished recording")]
    Foreign {
        /// The file.
        path: PathBuf,
    },
    /// The file has no frame that is whole.
    #[error("{path} has no whole frame")]
    Empty {
        /// The file.
        path: PathBuf,
    },
    /// The file is no table that a run writes.
    #[error("{path} is no table of a run: its first line names other columns")]
    ForeignTable {
        /// The file.
        path: PathBuf,
    },
    /// The complete file cannot be written.
    #[error("cannot write {path}: {source}")]
    Unwritable {
        /// The complete file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
}

/// Makes the complete file `target` of what a killed run left in `unfinished`, and removes that, if nothing in it is
/// damaged. `close` reads the one and writes the other; it has `None` to say where the first is of another kind.
///
/// # Errors
/// [`RecoveryError`]; then `unfinished` and `target` are as they were before, but where the complete file is there and
/// only `unfinished` cannot be removed.
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
        // What is said there makes no sense.
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

/// Makes the complete file of an unfinished one in which so many frames were written, and removes that. `close` is as
/// that of [`recover_by`].
///
/// # Errors
/// If `close` or the disk fails, or it found other frames; then the unfinished file stays, and the error says where.
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

/// Why a complete file is not made.
enum NotMade {
    /// The unfinished one is of another kind.
    Foreign,
    Unwritable(io::Error),
}

impl From<io::Error> for NotMade {
    fn from(error: io::Error) -> Self {
        Self::Unwritable(error)
    }
}
