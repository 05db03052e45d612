//! A film of what is shown.

use std::path::PathBuf;

use carom_render::{Film, FilmError, Picture};

/// Frames of a film in a second of simulated time.
const FRAMES_PER_SECOND: u32 = 30;

/// A film in the making: its frames are shown at equal distances of simulated time.
pub struct Recorder {
    film: Film,
    path: PathBuf,
    size: [u32; 2],
    /// Time of the first frame \[s\]; moved along with jumps of time.
    start: f64,
    /// Time shown last \[s\].
    last: f64,
    frames: u32,
}

/// More than this between two pictures of the interface is a jump to another time \[s\]: the fastest
/// speed on a machine that draws three pictures a second. Time that goes back is one, too.
const JUMP: f64 = 3.5;

impl Recorder {
    /// Begins a film at a time of the simulation \[s\].
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn begin(path: PathBuf, size: [u32; 2], start: f64) -> Result<Self, FilmError> {
        let film = Film::create(&path, size[0], size[1], FRAMES_PER_SECOND)?;
        Ok(Self { film, path, size, start, last: start, frames: 0 })
    }

    /// Adds what is shown at `time` \[s\], as often as frames have become due since the last call:
    /// a machine that cannot draw fast enough repeats frames, and the film keeps its time.
    ///
    /// # Errors
    /// If a frame cannot be added.
    pub fn add_due(
        &mut self,
        time: f64,
        picture: impl FnOnce([u32; 2]) -> Option<Picture>,
    ) -> Result<(), FilmError> {
        let way = time - self.last;
        if !(0.0..=JUMP).contains(&way) {
            // The film goes on with what is shown now.
            self.start += way;
        }
        self.last = time;
        let due = ((time - self.start) * f64::from(FRAMES_PER_SECOND)).floor() + 1.0;
        if due <= f64::from(self.frames) {
            return Ok(());
        }
        if let Some(picture) = picture(self.size) {
            while f64::from(self.frames) < due {
                self.film.add(&picture)?;
                self.frames += 1;
            }
        }
        Ok(())
    }

    /// Completes the film, and says where it is.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn finish(self) -> Result<String, FilmError> {
        let summary = self.film.finish()?;
        Ok(format!("saved {} ({:.1} s)", self.path.display(), summary.seconds))
    }
}
