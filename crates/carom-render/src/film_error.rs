//! Errors of films.

use std::io;
use std::path::{Path, PathBuf};

use muxide::api::MuxerError;
use thiserror::Error;

use crate::picture::PictureError;

/// Ticks of the clock of films: a frame lasts a whole number of ticks.
pub(crate) const TICKS_PER_SECOND: u32 = 90_000;
/// Larger than the rate of any screen.
pub(crate) const MOST_FRAMES_PER_SECOND: u32 = 240;
/// Sides of a picture \[px\]: at least a macroblock, at most what the encoder accepts.
pub(crate) const SMALLEST_SIDE: u32 = 16;
pub(crate) const LONGER_SIDE: u32 = 3840;
pub(crate) const SHORTER_SIDE: u32 = 2160;

/// Why a film failed.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum FilmError {
    /// A film cannot have pictures of this size.
    #[error(
        "a film cannot have {width} x {height} pixels: both must be even, at least \
         {SMALLEST_SIDE}, and at most {LONGER_SIDE} and {SHORTER_SIDE}"
    )]
    Size {
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
    },
    /// A film cannot have this frame rate.
    #[error(
        "a film cannot have {frames_per_second} frames per second: it must be a divisor of \
         {TICKS_PER_SECOND} like 24, 25, 30, 50, 60 or 120, and at most {MOST_FRAMES_PER_SECOND}"
    )]
    Rate {
        /// The rate requested.
        frames_per_second: u32,
    },
    /// A picture is not of the film's size.
    #[error("a picture of {picture:?} pixels does not fit into a film of {film:?} pixels")]
    OtherSize {
        /// Width and height of the picture.
        picture: [u32; 2],
        /// Width and height of the film.
        film: [u32; 2],
    },
    /// The number of pixels does not match the size of the picture.
    #[error(transparent)]
    Picture(#[from] PictureError),
    /// The file cannot grow further. The film can still be finished with the frames added before.
    #[error("the film is too long for one file after {frames} frames")]
    TooLong {
        /// Frames in the film.
        frames: u64,
    },
    /// The film has no frames, so no file was made.
    #[error("the film {path} has no frames")]
    Empty {
        /// The file.
        path: PathBuf,
    },
    /// The encoder refused a picture.
    #[error("cannot encode the film: {0}")]
    Encoder(#[from] openh264::Error),
    /// The frames cannot be written as an mp4 file.
    #[error("cannot put the film together: {0}")]
    Container(#[source] MuxerError),
    /// The file cannot be written.
    #[error("cannot write {path}: {source}")]
    Unwritable {
        /// The file.
        path: PathBuf,
        /// The cause.
        source: io::Error,
    },
}

pub(crate) fn unwritable(path: &Path, source: io::Error) -> FilmError {
    FilmError::Unwritable { path: path.to_owned(), source }
}
