//! Size and rate, which are the same for all frames of a film.

use crate::film_error::{
    FilmError, LONGER_SIDE, MOST_FRAMES_PER_SECOND, SHORTER_SIDE, SMALLEST_SIDE, TICKS_PER_SECOND,
};

/// Size and rate of a film.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct FilmForm {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    pub frames_per_second: u32,
}

impl FilmForm {
    /// Returns this form, or [`FilmError::Size`] or [`FilmError::Rate`] if films cannot have it.
    pub fn new(width: u32, height: u32, frames_per_second: u32) -> Result<Self, FilmError> {
        let (longer, shorter) = (width.max(height), width.min(height));
        let has_good_size = width.is_multiple_of(2)
            && height.is_multiple_of(2)
            && shorter >= SMALLEST_SIDE
            && longer <= LONGER_SIDE
            && shorter <= SHORTER_SIDE;
        if !has_good_size {
            return Err(FilmError::Size { width, height });
        }
        let has_good_rate = (1..=MOST_FRAMES_PER_SECOND).contains(&frames_per_second)
            && TICKS_PER_SECOND.is_multiple_of(frames_per_second);
        if !has_good_rate {
            return Err(FilmError::Rate { frames_per_second });
        }
        Ok(Self { width, height, frames_per_second })
    }

    /// Returns the duration of a frame \[1/90 000 s\].
    pub fn ticks_per_frame(self) -> u32 {
        TICKS_PER_SECOND / self.frames_per_second
    }

    /// Returns the time of a frame \[s\]; frame 0 is at 0.
    pub fn time_of(self, frame: u64) -> f64 {
        frame as f64 / f64::from(self.frames_per_second)
    }
}
