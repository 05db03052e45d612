//! Films: pictures encoded as H.264 in an mp4 file.

use std::io;
use std::path::{Path, PathBuf};

use carom_scene::unfinished::Unfinished;
use muxide::api::MuxerError;
use openh264::encoder::{
    BitRate, Encoder, EncoderConfig, FrameRate, IntraFramePeriod, Profile, QpRange,
    RateControlMode, VuiConfig,
};
use openh264::{OpenH264API, Timestamp};

use crate::film_error::{FilmError, unwritable};
use crate::film_form::FilmForm;
use crate::fragments::FragmentWriter;
use crate::picture::Picture;
use crate::plain_film::{self, CloseError};
use crate::yuv::Planes;

/// Time between keyframes \[s\]; players seek to these.
const SECONDS_BETWEEN_KEYFRAMES: u32 = 2;
/// Quantization parameter of all frames, from 0 to 51. At this value a film looks like its pictures
/// (plain areas are off by half a level), and its file is not large.
const QUANTIZATION: u8 = 18;
/// Largest number of bits per pixel and frame that a player should expect; the actual number
/// follows from the quantization alone.
const BITS_PER_PIXEL: f64 = 0.5;
/// Smallest and largest bit rate that the encoder accepts \[bit/s\]; H.264 allows at most 240
/// Mbit/s.
const BITS_PER_SECOND: [f64; 2] = [1e5, 2e8];

/// What a finished film contains.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilmSummary {
    /// Number of pictures.
    pub frames: u64,
    /// Duration \[s\].
    pub seconds: f64,
    /// Size of the file.
    pub bytes: u64,
}

/// A film that is being written: H.264 (BT.709 colours, 4:2:0) in an mp4 file that can be watched
/// while it is loaded. All frames last equally long.
///
/// The quality is constant, so the size depends on the pictures: about 10 MB a minute for a few
/// balls at 1280 x 720 pixels and 30 frames per second.
///
/// The file gets its name when it is complete. Until then the frames are in `NAME.0.unfinished`
/// beside it (1, 2, ... if that name is taken), which players can open, too. The operating system
/// has each frame when [`Self::add`] returns; [`recover_film`](crate::recover_film) makes the film
/// from the file that a killed process leaves. [`Self::finish`] holds all compressed frames in
/// memory and needs disk space for both files.
///
/// Dropping a film finishes it, unless it has no frames, but only [`Self::finish`] returns errors.
/// On an error the unfinished file stays.
pub struct Film {
    path: PathBuf,
    form: FilmForm,
    encoder: Encoder,
    planes: Planes,
    fragments: FragmentWriter,
    /// `None` once the film is finished.
    unfinished: Option<Unfinished>,
}

impl std::fmt::Debug for Film {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let mut text = f.debug_struct("Film");
        text.field("path", &self.path).field("form", &self.form);
        text.field("frames", &self.fragments.frames());
        text.finish_non_exhaustive()
    }
}

impl Film {
    /// Begins a film of `width` times `height` pixels at this path, which by custom ends in `.mp4`.
    /// Creates missing folders.
    ///
    /// # Errors
    /// [`FilmError::Size`] and [`FilmError::Rate`] for a size or rate that films cannot have,
    /// [`FilmError::Unwritable`] for a path that cannot be written.
    pub fn create(
        path: impl AsRef<Path>,
        width: u32,
        height: u32,
        frames_per_second: u32,
    ) -> Result<Self, FilmError> {
        let path = path.as_ref();
        let form = FilmForm::new(width, height, frames_per_second)?;
        let unfinished = Unfinished::create(path).map_err(|source| unwritable(path, source))?;
        let encoder = Encoder::with_api_config(OpenH264API::from_source(), encoder_config(form));
        let encoder = match encoder {
            Ok(encoder) => encoder,
            Err(error) => {
                // An error here would hide the first one.
                unfinished.remove().ok();
                return Err(error.into());
            }
        };
        Ok(Self {
            path: path.to_owned(),
            form,
            encoder,
            planes: Planes::new(width, height),
            fragments: FragmentWriter::new(form),
            unfinished: Some(unfinished),
        })
    }

    /// Adds a picture at the end. Its opacity is ignored.
    ///
    /// # Errors
    /// [`FilmError::OtherSize`] or [`FilmError::Picture`] for a picture that does not fit,
    /// [`FilmError::TooLong`] for a film of 4 GB. The film can be finished without it.
    pub fn add(&mut self, picture: &Picture) -> Result<(), FilmError> {
        picture.check_size()?;
        let FilmForm { width, height, .. } = self.form;
        let size = [picture.width, picture.height];
        if size != [width, height] {
            return Err(FilmError::OtherSize { picture: size, film: [width, height] });
        }
        let frames = self.fragments.frames();
        let has_room = self.fragments.bytes() < plain_film::MOST_BYTES;
        let Some(unfinished) = self.unfinished.as_mut().filter(|_| has_room) else {
            return Err(FilmError::TooLong { frames });
        };
        self.planes.read(picture);
        let milliseconds = Timestamp::from_millis((1000.0 * self.form.time_of(frames)) as u64);
        let bits = self.encoder.encode_at(&self.planes, milliseconds)?.to_vec();
        let added = self.fragments.add(&bits, unfinished.file());
        added.map_err(|source| unwritable(&self.path, source))
    }

    /// Makes the film from its unfinished file and removes that file.
    ///
    /// # Errors
    /// [`FilmError::Empty`] without frames, [`FilmError::Unwritable`] for a full disk. Then no new
    /// film exists, a file that was there before is unchanged, and the frames stay in the
    /// unfinished file.
    pub fn finish(mut self) -> Result<FilmSummary, FilmError> {
        self.complete()
    }

    fn complete(&mut self) -> Result<FilmSummary, FilmError> {
        let empty = || FilmError::Empty { path: self.path.clone() };
        let mut unfinished = self.unfinished.take().ok_or_else(empty)?;
        let frames = self.fragments.frames();
        let removed = |unfinished: Unfinished| {
            unfinished.remove().map_err(|source| unwritable(&self.path, source))
        };
        if frames == 0 {
            removed(unfinished)?;
            return Err(empty());
        }
        let closed = unfinished.close(|source, target| {
            let film = plain_film::close(source, target)?;
            if film.frames == frames { Ok(film) } else { Err(CloseError::Foreign) }
        });
        let bytes = closed.map_err(|error| self.kept(error, unfinished.place()))?.bytes;
        removed(unfinished)?;
        Ok(FilmSummary { frames, seconds: self.form.time_of(frames), bytes })
    }

    /// Returns the error for a film that cannot be made, with the path of its unfinished file.
    fn kept(&self, error: CloseError, place: Option<&Path>) -> FilmError {
        let source = match error {
            CloseError::Container(MuxerError::Io(source)) => source,
            CloseError::Container(error) => return FilmError::Container(error),
            CloseError::Foreign | CloseError::Empty => {
                io::Error::new(io::ErrorKind::InvalidData, "the unfinished film has changed")
            }
        };
        let Some(place) = place else { return unwritable(&self.path, source) };
        let frames = self.fragments.frames();
        let place = place.display();
        let kept = format!("{source}; its {frames} frames are in {place}, for `carom recover`");
        unwritable(&self.path, io::Error::new(source.kind(), kept))
    }
}

impl Drop for Film {
    fn drop(&mut self) {
        // A destructor cannot return an error.
        drop(self.complete());
    }
}

fn encoder_config(form: FilmForm) -> EncoderConfig {
    let FilmForm { width, height, frames_per_second } = form;
    let rate = f64::from(frames_per_second);
    let [least, most] = BITS_PER_SECOND;
    let bits_per_second = BITS_PER_PIXEL * f64::from(width) * f64::from(height) * rate;
    let bits_per_second = bits_per_second.clamp(least, most);
    EncoderConfig::new()
        .profile(Profile::High)
        // The quantization is fixed, so this mode has nothing to control.
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
