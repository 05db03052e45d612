//! Records a film frame by frame.

use std::path::Path;

use carom_render::{Camera, Film, FilmError, FilmSummary, Picture};

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
/// If it is dropped before [`Self::finish`], the frames recorded so far but the last are kept as a
/// film.
pub struct Filming<'a> {
    film: Film,
    /// The last frame, which is encoded while the next one is drawn.
    last: Option<Picture>,
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
        let fps = f64::from(order.fps);
        Ok(Self { film, last: None, footage, studio, camera, fps, frames: 0 })
    }

    /// Records a frame; returns its time \[s\].
    ///
    /// # Errors
    /// [`ShootError`] if footage, graphics device or disk fails.
    pub fn take_frame(&mut self) -> Result<f64, ShootError> {
        let time = self.frames as f64 / self.fps;
        let shot = self.studio.begin(self.footage, time, &self.camera)?;
        self.add_last()?;
        self.last = Some(self.studio.finish(shot)?);
        self.frames += 1;
        Ok(time)
    }

    /// Adds the last frame to the film.
    fn add_last(&mut self) -> Result<(), FilmError> {
        self.last.take().map_or(Ok(()), |picture| self.film.add(&picture))
    }

    /// Completes the film.
    ///
    /// # Errors
    /// [`FilmError`] if the film has no frames, or the disk fails.
    pub fn finish(mut self) -> Result<FilmSummary, FilmError> {
        let added = self.add_last();
        let summary = self.film.finish()?;
        added.map(|()| summary)
    }
}
