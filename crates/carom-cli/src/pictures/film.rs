//! A film: footage, frame by frame.

use std::path::Path;

use carom_render::{Camera, Film, FilmError, FilmSummary};

use super::error::ShootError;
use super::footage::Footage;
use super::studio::Studio;

/// A film that is to be made.
pub struct Order<'a> {
    /// Where it goes.
    pub path: &'a Path,
    /// Its frames per second.
    pub fps: u32,
}

/// A film that is being made.
///
/// Dropped before [`Self::finish`], what was filmed until then is a film, too.
pub struct Filming<'a> {
    film: Film,
    footage: &'a mut dyn Footage,
    studio: &'a mut Studio,
    camera: Camera,
    fps: f64,
    /// How many it has.
    frames: u64,
}

impl<'a> Filming<'a> {
    /// Begins a film of pictures from this studio.
    ///
    /// # Errors
    /// [`ShootError`] if films cannot have this size or rate, if the file cannot be written, or as
    /// [`Studio::camera`].
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

    /// Takes a frame, and tells its time \[s\].
    ///
    /// # Errors
    /// [`ShootError`] if footage, graphics device or disk fail.
    pub fn take_frame(&mut self) -> Result<f64, ShootError> {
        let time = self.frames as f64 / self.fps;
        self.film.add(&self.studio.picture(self.footage, time, &self.camera)?)?;
        self.frames += 1;
        Ok(time)
    }

    /// Writes the film.
    ///
    /// # Errors
    /// [`FilmError`] for a film without frames, and a disk that fails.
    pub fn finish(self) -> Result<FilmSummary, FilmError> {
        self.film.finish()
    }
}
