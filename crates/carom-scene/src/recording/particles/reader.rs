//! Reads frames of particle files.

use std::fs::{File, OpenOptions};
use std::io::{self, Read};
use std::path::Path;

use super::error::{Fault, ParticleError, Problem};
use super::frame::RawFrame;
use super::lines::Lines;
use super::{ParticleFormat, dump, xyz};
use crate::recording::recovered::RecoveryError;
use crate::unfinished::lock;

/// The last whole frame of a file.
#[derive(Debug)]
pub(super) struct LastFrame {
    pub frame: RawFrame,
    /// Number of whole frames.
    pub frames: u64,
    /// Whether a frame after it is cut short.
    pub is_cut: bool,
}

/// Reads the last whole frame. A last line without an end belongs to a whole frame only in a file
/// of one frame: there it was written by hand, not left by a killed run.
pub(super) fn last_frame(path: &Path, format: ParticleFormat) -> Result<LastFrame, ParticleError> {
    let unreadable = |source| ParticleError::Unreadable { path: path.to_owned(), source };
    let file = File::open(path).map_err(unreadable)?;
    last_whole(path, file, format, true)
}

/// Cuts a frame at the end of a particle file that a killed run left incomplete. Returns the number
/// of bytes removed.
///
/// # Errors
/// [`RecoveryError::Unreadable`] if the file cannot be read, is still being written or has a wrong
/// line; [`RecoveryError::Empty`] if it has no whole frame.
pub fn recover_particles(path: &Path, format: ParticleFormat) -> Result<u64, RecoveryError> {
    let unreadable = |source| RecoveryError::Unreadable { path: path.to_owned(), source };
    let file = OpenOptions::new().read(true).write(true).open(path).map_err(unreadable)?;
    lock(&file).map_err(unreadable)?;
    let same = file.try_clone().map_err(unreadable)?;
    let last = last_whole(path, same, format, false).map_err(|error| match error {
        ParticleError::Empty { path } => RecoveryError::Empty { path },
        ParticleError::Unreadable { source, .. } => unreadable(source),
        error => unreadable(io::Error::new(io::ErrorKind::InvalidData, error.to_string())),
    })?;
    let length = file.metadata().map_err(unreadable)?.len();
    file.set_len(last.frame.end).map_err(unreadable)?;
    Ok(length.saturating_sub(last.frame.end))
}

fn last_whole(
    path: &Path,
    file: impl Read,
    format: ParticleFormat,
    accepts_open_line: bool,
) -> Result<LastFrame, ParticleError> {
    let path = || path.to_owned();
    let mut lines = Lines::new(file);
    let (mut last, mut frames) = (None, 0);
    let is_cut = loop {
        match frame(&mut lines, format) {
            Ok(None) => break false,
            Ok(Some(frame)) if frame.has_end || (accepts_open_line && frames == 0) => {
                last = Some(frame);
                frames += 1;
            }
            Ok(Some(_)) | Err(Fault::CutShort) => break true,
            // A line that the end of the file cut may make no sense.
            Err(Fault::Problem(_)) if !lines.has_end && frames > 0 => break true,
            Err(Fault::Problem(Problem(problem))) => {
                return Err(ParticleError::Line { path: path(), line: lines.number, problem });
            }
            Err(Fault::Io(source)) => {
                return Err(ParticleError::Unreadable { path: path(), source });
            }
        }
    };
    let frame = last.ok_or_else(|| ParticleError::Empty { path: path() })?;
    Ok(LastFrame { frame, frames, is_cut })
}

/// Reads the next frame; `None` at the end of the file.
fn frame<R: Read>(lines: &mut Lines<R>, format: ParticleFormat) -> Result<Option<RawFrame>, Fault> {
    let header = match format {
        ParticleFormat::Xyz => xyz::read_header(lines)?,
        ParticleFormat::Dump => dump::read_header(lines)?,
    };
    let Some(header) = header else { return Ok(None) };
    let first_row = lines.number + 1;
    let mut rows = Vec::new();
    for _ in 0..header.count {
        rows.push(lines.next()?.ok_or(Fault::CutShort)?);
    }
    Ok(Some(RawFrame { header, rows, first_row, end: lines.position, has_end: lines.has_end }))
}
