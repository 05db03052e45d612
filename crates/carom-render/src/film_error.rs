//! Why a film fails.

use std::io;
use std::path::{Path, PathBuf};

use muxide::api::MuxerError;
use thiserror::Error;

use crate::picture::PictureError;

/// Time is counted in 1/90 000 s: a frame has to last a whole number of them.
pub(crate) const TICKS_PER_SECOND: u32 = 90_000;
/// More frames in a second than any screen shows.
pub(crate) const MOST_FRAMES_PER_SECOND: u32 = 240;
/// Sides of a picture \[px\]: a macroblock at least, at most what the encoder takes.
pub(crate) const SMALLEST_SIDE: u32 = 16;
pub(crate) const LONGER_SIDE: u32 = 3840;
pub(crate) const SHORTER_SIDE: u32 = 2160;

/// Why a film failed.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum FilmError {
    /// Films have no pictures of this size.
    #[error(
        "a film cannot have {width} x {height} pixels: both must be even, at least \
         {SMALLEST_SIDE}, and at most {LONGER_SIDE} and {SHORTER_SIDE}"
    )]
    Size {
        /// Pixels of a row.
        width: u32,
        /// Rows.
        height: u32,
    },
    /// Frames cannot follow each other at this rate.
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
    /// A picture's pixels are not as many as its size says.
    #[error(transparent)]
    Picture(#[from] PictureError),
    /// A file cannot hold more. What was added before can still be finished.
    #[error("the film is too long for one file after {frames} frames")]
    TooLong {
        /// Frames that it has.
        frames: u64,
    },
    /// Nothing was added: there is no film.
    #[error("the film {path} has no frames")]
    Empty {
        /// The file.
        path: PathBuf,
    },
    /// The encoder refused a picture.
    #[error("cannot encode the film: {0}")]
    Encoder(#[from] openh264::Error),
    /// Frames cannot be put together into a file.
    #[error("cannot put the film together: {0}")]
    Container(#[source] MuxerError),
    /// The file cannot be written.
    #[error("cannot write {path}: {source}")]
    Unwritable {
        /// The file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
}

/// The file cannot be written.
pub(crate) fn unwritable(path: &Path, source: io::Error) -> FilmError {
    FilmError::Unwritable { path: path.to_owned(), source }
}
