/// A stretch of time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Interval {
    /// Its beginning, on the world's clock \[s\].
    pub time: f64,
    /// Its length \[s\].
    pub h: f64,
}

impl Interval {
    /// The rest after a part \[s\] of it.
    pub fn after(self, elapsed: f64) -> Self {
        Self { time: self.time + elapsed, h: self.h - elapsed }
    }
}
