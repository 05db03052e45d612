//! Quantities over time, in bounded memory.

/// Most points of a series: more than a screen has columns.
pub const MAX_POINTS: usize = 4096;

/// A value for each of many frames, with a bound on how many: when there are more, every other one
/// is dropped and from then on frames are twice as far apart, so that a long run is still shown
/// from its beginning.
#[derive(Debug, Clone)]
pub struct Series<T> {
    /// Ascending by frame.
    points: Vec<(u64, T)>,
    /// Frames that are a multiple of this are kept.
    stride: u64,
}

impl<T> Default for Series<T> {
    fn default() -> Self {
        Self { points: Vec::new(), stride: 1 }
    }
}

impl<T> Series<T> {
    /// Whether the series has place for a point at this frame, and none there or later.
    pub fn wants(&self, frame: u64) -> bool {
        frame.is_multiple_of(self.stride) && self.points.last().is_none_or(|(at, _)| *at < frame)
    }

    /// Appends a point, if [`Self::wants`] it.
    pub fn push(&mut self, frame: u64, value: T) {
        if !self.wants(frame) {
            return;
        }
        self.points.push((frame, value));
        if self.points.len() > MAX_POINTS {
            self.stride *= 2;
            let stride = self.stride;
            self.points.retain(|(at, _)| at.is_multiple_of(stride));
        }
    }

    /// Drops what comes after this frame.
    pub fn cut(&mut self, frame: u64) {
        self.points.truncate(self.until(frame).len());
    }

    /// Drops everything.
    pub fn clear(&mut self) {
        self.points.clear();
        self.stride = 1;
    }

    /// Points up to this frame, with their frames.
    pub fn until(&self, frame: u64) -> &[(u64, T)] {
        &self.points[..self.points.partition_point(|(at, _)| *at <= frame)]
    }
}
