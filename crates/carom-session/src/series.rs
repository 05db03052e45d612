//! Quantities over time in limited memory.

/// Most points of a series: more than the columns of a screen.
pub const MAX_POINTS: usize = 4096;

/// Values at frames, with a limit on their number. When there are too many, every second point is
/// dropped, and the distance of new points doubles: a long run remains visible from its beginning.
#[derive(Debug, Clone)]
pub struct Series<T> {
    /// Points, ascending by frame.
    points: Vec<(u64, T)>,
    /// A frame is stored if its number is a multiple of this.
    stride: u64,
}

impl<T> Default for Series<T> {
    fn default() -> Self {
        Self { points: Vec::new(), stride: 1 }
    }
}

impl<T> Series<T> {
    /// Whether the series stores this frame and has no point at it or later.
    pub fn wants(&self, frame: u64) -> bool {
        frame.is_multiple_of(self.stride) && self.points.last().is_none_or(|(at, _)| *at < frame)
    }

    /// Appends a point if [`Self::wants`] returns true.
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

    /// Drops the points after this frame.
    pub fn cut(&mut self, frame: u64) {
        self.points.truncate(self.until(frame).len());
    }

    /// Drops everything.
    pub fn clear(&mut self) {
        self.points.clear();
        self.stride = 1;
    }

    /// Points up to this frame.
    pub fn until(&self, frame: u64) -> &[(u64, T)] {
        &self.points[..self.points.partition_point(|(at, _)| *at <= frame)]
    }
}
