//! Records a film frame by frame.

use std::path::Path;

use carom_render::{Camera, Film, FilmError, FilmSummary};

use super::error::ShootError;
use super::footage::Footage;
use super::studio::Studio;

/// File and rate of a film to record.
pub struct Order<'a> {
    /// File of the film.
    pub path: &'a Path,
    /// Frames per second.
    pub fps: u32,
}

/// A film that is being recorded.
///
/// If it is dropped before [`Self::finish`], the frames recorded so far are kept as a film.
pub struct Filming<'a> {
    film: Film,
    footage: &'a mut dyn Footage,
    studio: &'a mut Studio,
    camera: Camera,
    fps: f64,
    /// Number of frames so far.
    frames: u64,
}

impl<'a> Filming<'a> {
    /// Starts a film of `footage`.
    ///
    /// # Errors
    /// [`ShootError`] if a film cannot have this size or rate, if the file cannot be written, or
    /// for an error of [`Studio::camera`].
    pub fn begin(
        order: Order,
        footage: &'a mut dyn Footage,
        studio: &'a mut Studio,
    ) -> Result<Self, ShootError> {
        let [width, height] = studio.size();
        let film = Film::create(order.path, width, height, order.fps)?;
        let camera = studio.camera(footage, 0.0)?;
        Ok(Self { film, footage, studio, camera, fps: f64::from(order.fps), frames: 0 })
    }

    /// Records a frame; returns its time \[s\].
    ///
    /// # Errors
    /// [`ShootError`] if footage, graphics device or disk fails.
    pub fn take_frame(&mut self) -> Result<f64, ShootError> {
        let time = self.frames as f64 / self.fps;
        self.film.add(&self.studio.picture(self.footage, time, &self.camera)?)?;
        self.frames += 1;
        Ok(time)
    }

    /// Completes the film.
    ///
    /// # Errors
    /// [`FilmError`] if the film has no frames, or the disk fails.
    pub fn finish(self) -> Result<FilmSummary, FilmError> {
        self.film.finish()
    }
}
