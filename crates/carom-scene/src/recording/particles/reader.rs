//! Reads frames of particle files.

use std::fs::{File, OpenOptions};
use std::io::{self, Read};
use std::path::Path;

use super::error::{Fault, ParticleError, Problem};
use super::frame::{ParticleFrame, RawFrame};
use super::gsd::GsdReader;
use super::lines::Lines;
use super::{ParticleFormat, dump, rows, xyz};
use crate::recording::recovered::RecoveryError;
use crate::unfinished::lock;

/// One whole frame of a file.
#[derive(Debug)]
pub(super) struct OneFrame {
    pub frame: ParticleFrame,
    /// Number of whole frames.
    pub frames: u64,
    /// Whether a frame after them is cut short.
    pub is_cut: bool,
}

/// What the frames of a text file leave.
struct Ending {
    /// Number of whole frames.
    frames: u64,
    /// Position in the file after the last whole frame \[bytes\].
    end: u64,
    /// Whether a frame after them is cut short.
    is_cut: bool,
}

/// Reads the whole frame with a number, from 0, or the last one.
pub(super) fn one_frame(
    path: &Path,
    format: ParticleFormat,
    number: Option<u64>,
) -> Result<OneFrame, ParticleError> {
    if format == ParticleFormat::Gsd {
        let mut reader = GsdReader::open(path)?;
        let frames = reader.frames();
        let frame = reader.frame(existing(path, number, frames)?)?;
        return Ok(OneFrame { frame, frames, is_cut: false });
    }
    let (mut found, mut next) = (None, 0);
    let Ending { frames, is_cut, .. } = each_frame(path, opened(path)?, format, true, |frame| {
        if number.is_none_or(|number| number == next) {
            found = Some(frame);
        }
        next += 1;
        Ok(())
    })?;
    existing(path, number, frames)?;
    let empty = || ParticleError::Empty { path: path.to_owned() };
    let frame = parsed(path, &found.ok_or_else(empty)?, format)?;
    Ok(OneFrame { frame, frames, is_cut })
}

/// Reads all whole frames of a particle file.
///
/// Numbers are taken as SI units, to the bit. Particles are in the order of their numbers, else in
/// that of the file. A periodic box is moved to the origin. A frame that is cut short at the end of
/// the file is left out.
///
/// # Errors
/// [`ParticleError`] if the file cannot be read, a line is wrong, or no frame is whole.
pub fn read_particles(
    path: &Path,
    format: ParticleFormat,
) -> Result<Vec<ParticleFrame>, ParticleError> {
    if format == ParticleFormat::Gsd {
        let mut reader = GsdReader::open(path)?;
        existing(path, None, reader.frames())?;
        return (0..reader.frames()).map(|number| reader.frame(number)).collect();
    }
    let mut frames = Vec::new();
    each_frame(path, opened(path)?, format, true, |frame| {
        frames.push(parsed(path, &frame, format)?);
        Ok(())
    })?;
    Ok(frames)
}

/// Cuts a frame at the end of a particle file that a killed run left incomplete. Returns the number
/// of bytes removed; none of a GSD file, whose index has whole frames only.
///
/// # Errors
/// [`RecoveryError::Unreadable`] if the file cannot be read, is still being written or has a wrong
/// line; [`RecoveryError::Empty`] if it has no whole frame.
pub fn recover_particles(path: &Path, format: ParticleFormat) -> Result<u64, RecoveryError> {
    let unreadable = |source| RecoveryError::Unreadable { path: path.to_owned(), source };
    let refused = |error| match error {
        ParticleError::Empty { path } => RecoveryError::Empty { path },
        ParticleError::Unreadable { source, .. } => unreadable(source),
        error => unreadable(io::Error::new(io::ErrorKind::InvalidData, error.to_string())),
    };
    let file = OpenOptions::new().read(true).write(true).open(path).map_err(unreadable)?;
    lock(&file).map_err(unreadable)?;
    if format == ParticleFormat::Gsd {
        let reader = GsdReader::open(path).map_err(refused)?;
        return existing(path, None, reader.frames()).map(|_| 0).map_err(refused);
    }
    let same = file.try_clone().map_err(unreadable)?;
    let Ending { end, .. } = each_frame(path, same, format, false, |_| Ok(())).map_err(refused)?;
    let length = file.metadata().map_err(unreadable)?.len();
    file.set_len(end).map_err(unreadable)?;
    Ok(length.saturating_sub(end))
}

fn opened(path: &Path) -> Result<File, ParticleError> {
    File::open(path).map_err(|source| ParticleError::Unreadable { path: path.to_owned(), source })
}

/// Returns the number of a frame, or of the last one, if the file has it.
fn existing(path: &Path, number: Option<u64>, frames: u64) -> Result<u64, ParticleError> {
    let path = || path.to_owned();
    let last = frames.checked_sub(1).ok_or_else(|| ParticleError::Empty { path: path() })?;
    match number {
        Some(frame) if frame > last => Err(ParticleError::NoFrame { path: path(), frame, last }),
        number => Ok(number.unwrap_or(last)),
    }
}

fn parsed(
    path: &Path,
    frame: &RawFrame,
    format: ParticleFormat,
) -> Result<ParticleFrame, ParticleError> {
    rows::parse(frame, format).map_err(|(line, Problem(problem))| ParticleError::Line {
        path: path.to_owned(),
        line,
        problem,
    })
}

/// Visits every whole frame of a text file, of which there must be one. A last line without an end
/// belongs to a whole frame only in a file of one frame: there it was written by hand, not left by
/// a killed run.
fn each_frame(
    path: &Path,
    file: impl Read,
    format: ParticleFormat,
    accepts_open_line: bool,
    mut visit: impl FnMut(RawFrame) -> Result<(), ParticleError>,
) -> Result<Ending, ParticleError> {
    let path = || path.to_owned();
    let mut lines = Lines::new(file);
    let (mut end, mut frames) = (0, 0);
    let is_cut = loop {
        match frame(&mut lines, format) {
            Ok(None) => break false,
            Ok(Some(frame)) if frame.has_end || (accepts_open_line && frames == 0) => {
                end = frame.end;
                visit(frame)?;
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
    if frames == 0 {
        return Err(ParticleError::Empty { path: path() });
    }
    Ok(Ending { frames, end, is_cut })
}

/// Reads the next frame; `None` at the end of the file.
fn frame<R: Read>(lines: &mut Lines<R>, format: ParticleFormat) -> Result<Option<RawFrame>, Fault> {
    let header = match format {
        ParticleFormat::Dump => dump::read_header(lines)?,
        ParticleFormat::Xyz | ParticleFormat::Gsd => xyz::read_header(lines)?,
    };
    let Some(header) = header else { return Ok(None) };
    let first_row = lines.number + 1;
    let mut rows = Vec::new();
    for _ in 0..header.count {
        rows.push(lines.next()?.ok_or(Fault::CutShort)?);
    }
    Ok(Some(RawFrame { header, rows, first_row, end: lines.position, has_end: lines.has_end }))
}
