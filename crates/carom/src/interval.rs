/// A stretch of time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Interval {
    /// Beginning of the interval, on the world's clock \[s\].
    pub time: f64,
    /// Length of the interval \[s\].
    pub h: f64,
}

impl Interval {
    /// Returns the rest of the interval after a part \[s\] of it.
    pub fn after(self, elapsed: f64) -> Self {
        Self { time: self.time + elapsed, h: self.h - elapsed }
    }
}
