//! Complete films: mp4 files with one table of all frames at the start.

use std::fs::File;
use std::io::{self, BufWriter};
use std::path::Path;

use carom_scene::recording::{Recovered, RecoveryError};
use carom_scene::unfinished::Unfinished;
use muxide::api::{MuxerBuilder, MuxerError, VideoCodec};

use crate::film_form::FilmForm;
use crate::fragments::Fragments;

/// Offsets in the file have 32 bits; the rest is for the tables and the frame being written.
pub(crate) const MOST_BYTES: u64 = 4_000_000_000;

/// The film made from a growing one.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Closed {
    pub form: FilmForm,
    pub frames: u64,
    /// Size of the complete file.
    pub bytes: u64,
    /// Bytes of the growing film after its last whole frame.
    pub left_out: u64,
    /// Whether these bytes are damaged, not only an incomplete frame.
    pub is_damaged: bool,
}

/// Why no film was made from a growing one.
#[derive(Debug)]
pub(crate) enum CloseError {
    /// The file is no growing film.
    Foreign,
    /// It has no whole frame.
    Empty,
    /// The file cannot be read, or the film cannot be written.
    Container(MuxerError),
}

impl From<io::Error> for CloseError {
    fn from(error: io::Error) -> Self {
        Self::Container(MuxerError::Io(error))
    }
}

impl From<MuxerError> for CloseError {
    fn from(error: MuxerError) -> Self {
        Self::Container(error)
    }
}

/// Writes a complete film from the whole frames of a growing one.
pub(crate) fn close(source: &mut File, target: File) -> Result<Closed, CloseError> {
    let is_empty = source.metadata()?.len() == 0;
    let fragments = Fragments::open(source)?;
    let mut fragments =
        fragments.ok_or(if is_empty { CloseError::Empty } else { CloseError::Foreign })?;
    let form = fragments.form;
    let mut muxer = MuxerBuilder::new(BufWriter::new(target))
        .video(VideoCodec::H264, form.width, form.height, form.frames_per_second.into())
        .with_fast_start(true)
        .build()?;
    let mut read = 0;
    let mut time = 0.0;
    while let Some(frame) = fragments.next_frame()? {
        // No more than a film may hold: the last frame may exceed that.
        if read >= MOST_BYTES {
            let text = "it is longer than a film can be";
            return Err(io::Error::new(io::ErrorKind::InvalidData, text).into());
        }
        read += frame.bits.len() as u64;
        muxer.write_video(time, &frame.bits, frame.is_keyframe)?;
        time = form.time_of(fragments.frames);
    }
    if fragments.frames == 0 {
        return Err(CloseError::Empty);
    }
    let bytes = muxer.finish_in_place_with_stats()?.bytes_written;
    muxer.into_writer().into_inner().map_err(io::IntoInnerError::into_error)?;
    let Fragments { frames, rest, is_damaged, .. } = fragments;
    Ok(Closed { form, frames, bytes, left_out: rest, is_damaged })
}

/// Makes the film `target` from the file `unfinished` that a killed process left, and removes that
/// file.
///
/// # Errors
/// [`RecoveryError`]; then `unfinished` and `target` are unchanged. One exception: if only the
/// removal of `unfinished` fails, `target` is the complete film.
pub fn recover_film(unfinished: &Path, target: &Path) -> Result<Recovered, RecoveryError> {
    let path = unfinished.to_owned();
    let unreadable = |source| RecoveryError::Unreadable { path: unfinished.to_owned(), source };
    let mut file = Unfinished::open(unfinished, target).map_err(unreadable)?;
    let closed = file.close(close).map_err(|error| {
        let source = match error {
            CloseError::Foreign => return RecoveryError::Foreign { path },
            CloseError::Empty => return RecoveryError::Empty { path },
            CloseError::Container(MuxerError::Io(source)) => source,
            CloseError::Container(error) => io::Error::other(error),
        };
        RecoveryError::Unwritable { path: target.to_owned(), source }
    })?;
    if !closed.is_damaged {
        file.remove().map_err(unreadable)?;
    }
    Ok(Recovered {
        frames: closed.frames,
        last: Some(closed.form.time_of(closed.frames - 1)),
        left_out: closed.left_out,
        is_damaged: closed.is_damaged,
    })
}
