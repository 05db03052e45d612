//! Films: pictures in a row as H.264 in an mp4 file.

use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};

use muxide::api::{Muxer, MuxerBuilder, MuxerError, VideoCodec};
use openh264::encoder::{
    BitRate, Encoder, EncoderConfig, FrameRate, FrameType, IntraFramePeriod, Profile, QpRange,
    RateControlMode, VuiConfig,
};
use openh264::{OpenH264API, Timestamp};
use thiserror::Error;

use crate::new_file::NewFile;
use crate::picture::{Picture, PictureError};
use crate::yuv::Planes;

/// Time is counted in 1/90 000 s: a frame has to last a whole number of them.
const TICKS_PER_SECOND: u32 = 90_000;
/// More frames in a second than any screen shows.
const MOST_FRAMES_PER_SECOND: u32 = 240;
/// Sides of a picture \[px\]: a macroblock at least, at most what the encoder takes.
const SMALLEST_SIDE: u32 = 16;
const LONGER_SIDE: u32 = 3840;
const SHORTER_SIDE: u32 = 2160;
/// Offsets in the file have 32 bits; the tables and the frame at work need some, too.
const MOST_BYTES: u64 = 4_000_000_000;
/// Time from one frame that stands for itself to the next \[s\]: players seek to these.
const SECONDS_BETWEEN_KEYFRAMES: u32 = 2;
/// Quantization parameter of all frames, of 0 to 51: at this one a film is hard to tell from its
/// pictures (values of plain areas are off by half a level), and not large.
const QUANTIZATION: u8 = 18;
/// Most bits per pixel and frame that a player should be prepared for; what is used follows from
/// the quantization alone.
const BITS_PER_PIXEL: f64 = 0.5;
/// The least and the most that the encoder accepts \[bit/s\]: H.264 knows at most 240 Mbit/s.
const BITS_PER_SECOND: [f64; 2] = [1e5, 2e8];

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

/// What became of a film.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilmSummary {
    /// Pictures.
    pub frames: u64,
    /// How long they last \[s\].
    pub seconds: f64,
    /// Size of the file.
    pub bytes: u64,
}

/// A film in the making: H.264 (BT.709 colours, 4:2:0) in an mp4 file that can be watched while
/// it is loaded. Every frame lasts equally long.
///
/// Quality is the same throughout, so the size follows from what is to be seen. Frames wait in
/// memory, compressed, until [`Self::finish`] writes them: some 10 MB for each minute of a few
/// balls at 1280 x 720 pixels and 30 frames per second. So a full disk shows only then.
///
/// The file gets its name once it is complete. A film that is dropped is finished as it is, unless
/// it has no frames; [`Self::finish`] tells whether that went well.
pub struct Film {
    path: PathBuf,
    size: [u32; 2],
    frames_per_second: u32,
    encoder: Encoder,
    planes: Planes,
    /// `None` once the film is finished.
    muxer: Option<Muxer<BufWriter<NewFile>>>,
    frames: u64,
    bytes: u64,
}

impl std::fmt::Debug for Film {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { path, size, frames, .. } = self;
        let mut text = f.debug_struct("Film");
        text.field("path", path).field("size", size).field("frames", frames);
        text.finish_non_exhaustive()
    }
}

impl Film {
    /// Begins a film of `width` times `height` pixels at this path, `.mp4` by custom. Folders that
    /// are missing are made.
    ///
    /// # Errors
    /// [`FilmError::Size`] and [`FilmError::Rate`] for what films cannot have,
    /// [`FilmError::Unwritable`] for a place that cannot be written to.
    pub fn create(
        path: impl AsRef<Path>,
        width: u32,
        height: u32,
        frames_per_second: u32,
    ) -> Result<Self, FilmError> {
        let path = path.as_ref();
        check_size(width, height)?;
        let is_whole = (1..=MOST_FRAMES_PER_SECOND).contains(&frames_per_second)
            && TICKS_PER_SECOND.is_multiple_of(frames_per_second);
        if !is_whole {
            return Err(FilmError::Rate { frames_per_second });
        }
        let file = NewFile::create(path).map_err(|source| unwritable(path, source))?;
        let encoder = Encoder::with_api_config(
            OpenH264API::from_source(),
            encoder_config(width, height, frames_per_second),
        )?;
        let muxer = MuxerBuilder::new(BufWriter::new(file))
            .video(VideoCodec::H264, width, height, frames_per_second.into())
            .with_fast_start(true)
            .build()
            .map_err(|error| container(path, error))?;
        Ok(Self {
            path: path.to_owned(),
            size: [width, height],
            frames_per_second,
            encoder,
            planes: Planes::new(width, height),
            muxer: Some(muxer),
            frames: 0,
            bytes: 0,
        })
    }

    /// Adds a picture, which is seen after those before it. Its opacity is left aside.
    ///
    /// # Errors
    /// [`FilmError::OtherSize`] or [`FilmError::Picture`] for a picture that does not fit,
    /// [`FilmError::TooLong`] for a film of 4 GB. The film can be finished without it.
    pub fn add(&mut self, picture: &Picture) -> Result<(), FilmError> {
        picture.check_size()?;
        let size = [picture.width, picture.height];
        if size != self.size {
            return Err(FilmError::OtherSize { picture: size, film: self.size });
        }
        let Some(muxer) = self.muxer.as_mut().filter(|_| self.bytes < MOST_BYTES) else {
            return Err(FilmError::TooLong { frames: self.frames });
        };
        self.planes.read(picture);
        let time = self.frames as f64 / f64::from(self.frames_per_second);
        let milliseconds = Timestamp::from_millis((1000.0 * time) as u64);
        let encoded = self.encoder.encode_at(&self.planes, milliseconds)?;
        let is_keyframe = encoded.frame_type() == FrameType::IDR;
        let bits = encoded.to_vec();
        let added = muxer.write_video(time, &bits, is_keyframe);
        added.map_err(|error| container(&self.path, error))?;
        self.frames += 1;
        self.bytes += bits.len() as u64;
        Ok(())
    }

    /// Writes the film.
    ///
    /// # Errors
    /// [`FilmError::Empty`] without frames, [`FilmError::Unwritable`] for a full disk; then there
    /// is no file, or the one that was there before.
    pub fn finish(mut self) -> Result<FilmSummary, FilmError> {
        self.complete()
    }

    fn complete(&mut self) -> Result<FilmSummary, FilmError> {
        let Some(mut muxer) = self.muxer.take().filter(|_| self.frames > 0) else {
            return Err(FilmError::Empty { path: self.path.clone() });
        };
        let stats =
            muxer.finish_in_place_with_stats().map_err(|error| container(&self.path, error))?;
        let file = muxer.into_writer().into_inner().map_err(io::IntoInnerError::into_error);
        let completed = file.and_then(NewFile::complete);
        completed.map_err(|source| unwritable(&self.path, source))?;
        Ok(FilmSummary {
            frames: self.frames,
            seconds: self.frames as f64 / f64::from(self.frames_per_second),
            bytes: stats.bytes_written,
        })
    }
}

impl Drop for Film {
    fn drop(&mut self) {
        // An error here has no caller to go to.
        drop(self.complete());
    }
}

fn check_size(width: u32, height: u32) -> Result<(), FilmError> {
    let (longer, shorter) = (width.max(height), width.min(height));
    let is_good = width.is_multiple_of(2)
        && height.is_multiple_of(2)
        && shorter >= SMALLEST_SIDE
        && longer <= LONGER_SIDE
        && shorter <= SHORTER_SIDE;
    if is_good { Ok(()) } else { Err(FilmError::Size { width, height }) }
}

fn encoder_config(width: u32, height: u32, frames_per_second: u32) -> EncoderConfig {
    let rate = f64::from(frames_per_second);
    let [least, most] = BITS_PER_SECOND;
    let bits_per_second = BITS_PER_PIXEL * f64::from(width) * f64::from(height) * rate;
    let bits_per_second = bits_per_second.clamp(least, most);
    EncoderConfig::new()
        .profile(Profile::High)
        // Between these bounds, this mode of control has nothing left to control.
        .rate_control_mode(RateControlMode::Bufferbased)
        .qp(QpRange::new(QUANTIZATION, QUANTIZATION))
        .adaptive_quantization(false)
        .bitrate(BitRate::from_bps(bits_per_second as u32))
        .max_frame_rate(FrameRate::from_hz(rate as f32))
        .intra_frame_period(IntraFramePeriod::from_num_frames(
            SECONDS_BETWEEN_KEYFRAMES * frames_per_second,
        ))
        .skip_frames(false)
        .background_detection(false)
        .vui(VuiConfig::bt709())
        .num_threads(1)
}

fn container(path: &Path, error: MuxerError) -> FilmError {
    match error {
        MuxerError::Io(source) => unwritable(path, source),
        error => FilmError::Container(error),
    }
}

fn unwritable(path: &Path, source: io::Error) -> FilmError {
    FilmError::Unwritable { path: path.to_owned(), source }
}
