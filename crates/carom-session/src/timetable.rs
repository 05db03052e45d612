//! Which frame is at which time, where frames change their length.

use crate::change::PastChange;
use crate::error::SessionError;

/// More frames than this \[1\] are not gone to: they would take too long, and a number in a link
/// that has too many digits is a mistake.
const MOST_FRAMES: f64 = 1e8;

/// A stretch of frames of one length.
#[derive(Debug, Clone, Copy)]
struct Piece {
    frame: u64,
    /// At its first frame \[s\].
    time: f64,
    /// \[s\]
    frame_time: f64,
}

/// Which frame is at which time.
#[derive(Debug, Clone)]
pub(crate) struct Timetable {
    /// Ascending; never empty.
    pieces: Vec<Piece>,
}

impl Timetable {
    /// Of frames of one length \[s\].
    pub fn new(frame_time: f64) -> Self {
        Self { pieces: vec![Piece { frame: 0, time: 0.0, frame_time }] }
    }

    /// Forgets what comes after this frame.
    pub fn cut(&mut self, frame: u64) {
        self.pieces.retain(|piece| piece.frame <= frame);
    }

    /// From this frame on, which is the last and at `time` \[s\], frames last for `frame_time` \[s\].
    pub fn note(&mut self, frame: u64, time: f64, frame_time: f64) {
        if self.last().frame_time != frame_time {
            self.pieces.retain(|piece| piece.frame < frame);
            self.pieces.push(Piece { frame, time, frame_time });
        }
    }

    /// Predicts what changes to come, ascending by frame, make of it; their times are then
    /// products instead of sums, and may be off by rounding.
    pub fn extend(&mut self, changes: &[PastChange]) {
        for PastChange { frame, change } in changes {
            if let Some(frame_time) = change.frame_time() {
                let last = self.last();
                let frames = frame.saturating_sub(last.frame) as f64;
                self.note(*frame, last.time + frames * last.frame_time, frame_time);
            }
        }
    }

    /// The frame nearest to a time \[s\].
    ///
    /// # Errors
    /// [`SessionError::Time`] for a time that is negative or not finite, [`SessionError::TooFar`]
    /// for one more than 100,000,000 frames after the start.
    pub fn frame_at(&self, time: f64) -> Result<u64, SessionError> {
        if !(time >= 0.0 && time.is_finite()) {
            return Err(SessionError::Time { seconds: time });
        }
        let later = self.pieces.partition_point(|piece| piece.time <= time);
        let piece = self.pieces[later.saturating_sub(1)];
        let frames = ((time - piece.time) / piece.frame_time).round().max(0.0);
        let next = self.pieces.get(later).map_or(u64::MAX, |piece| piece.frame);
        // A cast of a number that is too large gives the largest.
        let frame = piece.frame.saturating_add(frames as u64).min(next);
        if frame as f64 > MOST_FRAMES {
            return Err(SessionError::TooFar { seconds: time });
        }
        Ok(frame)
    }

    /// The time of a frame \[s\], to rounding.
    pub fn time_of(&self, frame: u64) -> f64 {
        let later = self.pieces.partition_point(|piece| piece.frame <= frame);
        let piece = self.pieces[later.saturating_sub(1)];
        piece.time + frame.saturating_sub(piece.frame) as f64 * piece.frame_time
    }

    fn last(&self) -> Piece {
        self.pieces[self.pieces.len() - 1]
    }
}
