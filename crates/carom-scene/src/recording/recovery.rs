//! What killed runs leave, made complete.

use std::fs::OpenOptions;
use std::io::{self, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use thiserror::Error;

use super::npz;
use super::npz_journal::Journal;
use crate::unfinished::{Unfinished, lock};

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
    /// The complete file cannot be written.
    #[error("cannot write {path}: {source}")]
    Unwritable {
        /// The complete file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
}

/// Makes the NPZ file `target` of what a killed run left in `unfinished`, and removes that.
///
/// # Errors
/// [`RecoveryError`]; then `unfinished` and `target` are as they were before.
pub fn recover(unfinished: &Path, target: &Path) -> Result<Recovered, RecoveryError> {
    let unreadable = |source| RecoveryError::Unreadable { path: unfinished.to_owned(), source };
    let unwritable = |source| RecoveryError::Unwritable { path: target.to_owned(), source };
    let mut file = Unfinished::open(unfinished, target).map_err(unreadable)?;
    let journal = Journal::open(file.file()).map_err(unreadable)?;
    let extent = journal.map(|journal| journal.extent);
    let extent = extent.ok_or_else(|| RecoveryError::Foreign { path: unfinished.to_owned() })?;
    let closed = file.close(|source, target| match Journal::open(source)? {
        Some(mut journal) => npz::archive(&mut journal, target),
        None => Ok(()),
    });
    closed.map_err(unwritable)?;
    if !extent.is_damaged {
        file.remove().map_err(unreadable)?;
    }
    Ok(Recovered {
        frames: extent.frames,
        last: extent.last,
        left_out: extent.rest,
        is_damaged: extent.is_damaged,
    })
}

/// Cuts off the last line of a table if it has no end, as a killed run may leave it; returns how many
/// bytes that were.
///
/// # Errors
/// [`RecoveryError::Unreadable`], [`RecoveryError::Foreign`] for a file without an end of a line.
pub fn recover_table(path: &Path) -> Result<u64, RecoveryError> {
    let cut = cut_last_line(path);
    let cut = cut.map_err(|source| RecoveryError::Unreadable { path: path.to_owned(), source })?;
    cut.ok_or_else(|| RecoveryError::Foreign { path: path.to_owned() })
}

/// `None` where no line has an end.
fn cut_last_line(path: &Path) -> io::Result<Option<u64>> {
    let mut file = OpenOptions::new().read(true).write(true).open(path)?;
    lock(&file)?;
    let length = file.seek(SeekFrom::End(0))?;
    let mut block = [0; 4096];
    let mut end = length;
    while end > 0 {
        let start = end.saturating_sub(block.len() as u64);
        let part = &mut block[..(end - start) as usize];
        file.seek(SeekFrom::Start(start))?;
        file.read_exact(part)?;
        if let Some(place) = part.iter().rposition(|byte| *byte == b'\n') {
            let whole = start + place as u64 + 1;
            if whole < length {
                file.set_len(whole)?;
            }
            return Ok(Some(length - whole));
        }
        end = start;
    }
    Ok(None)
}
