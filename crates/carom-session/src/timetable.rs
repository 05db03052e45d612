//! Times of frames whose length may change.

use crate::change::PastChange;
use crate::error::SessionError;

/// Most frames from the start: more would take too long, and a link with such a time probably
/// contains a mistake.
const MOST_FRAMES: f64 = 1e8;

/// Frames of equal length.
#[derive(Debug, Clone, Copy)]
struct Piece {
    frame: u64,
    /// Time of the first frame \[s\].
    time: f64,
    /// Length of a frame \[s\].
    frame_time: f64,
}

/// Times of frames.
#[derive(Debug, Clone)]
pub(crate) struct Timetable {
    /// Ascending by frame; never empty.
    pieces: Vec<Piece>,
}

impl Timetable {
    /// Creates a timetable with frames of one length \[s\].
    pub fn new(frame_time: f64) -> Self {
        Self { pieces: vec![Piece { frame: 0, time: 0.0, frame_time }] }
    }

    /// Removes everything after this frame.
    pub fn cut(&mut self, frame: u64) {
        self.pieces.retain(|piece| piece.frame <= frame);
    }

    /// Records that frames after this one, at `time` \[s\], last `frame_time` \[s\].
    pub fn note(&mut self, frame: u64, time: f64, frame_time: f64) {
        if self.last().frame_time != frame_time {
            self.pieces.retain(|piece| piece.frame < frame);
            self.pieces.push(Piece { frame, time, frame_time });
        }
    }

    /// Adds future changes, ascending by frame. Their times are products instead of sums, so they
    /// may have rounding errors.
    pub fn extend(&mut self, changes: &[PastChange]) {
        for PastChange { frame, change } in changes {
            if let Some(frame_time) = change.frame_time() {
                let last = self.last();
                let frames = frame.saturating_sub(last.frame) as f64;
                self.note(*frame, last.time + frames * last.frame_time, frame_time);
            }
        }
    }

    /// Frame nearest to a time \[s\].
    ///
    /// # Errors
    /// [`SessionError::Time`] if the time is negative or not finite, [`SessionError::TooFar`] if it
    /// is more than 100,000,000 frames after the start.
    pub fn frame_at(&self, time: f64) -> Result<u64, SessionError> {
        if !(time >= 0.0 && time.is_finite()) {
            return Err(SessionError::Time { seconds: time });
        }
        let later = self.pieces.partition_point(|piece| piece.time <= time);
        let piece = self.pieces[later.saturating_sub(1)];
        let frames = ((time - piece.time) / piece.frame_time).round().max(0.0);
        let next = self.pieces.get(later).map_or(u64::MAX, |piece| piece.frame);
        // A cast of a number that is too large returns the largest integer.
        let frame = piece.frame.saturating_add(frames as u64).min(next);
        if frame as f64 > MOST_FRAMES {
            return Err(SessionError::TooFar { seconds: time });
        }
        Ok(frame)
    }

    /// Time of a frame \[s\], up to rounding.
    pub fn time_of(&self, frame: u64) -> f64 {
        let later = self.pieces.partition_point(|piece| piece.frame <= frame);
        let piece = self.pieces[later.saturating_sub(1)];
        piece.time + frame.saturating_sub(piece.frame) as f64 * piece.frame_time
    }

    fn last(&self) -> Piece {
        self.pieces[self.pieces.len() - 1]
    }
}
