use crate::sum::Sum;

/// The time of a world: a sum of step lengths that does not drift, however many there are.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Clock(Sum);

impl Clock {
    /// A clock that shows this time \[s\].
    pub fn at(seconds: f64) -> Self {
        Self(std::iter::once(seconds).collect())
    }

    /// Time since the beginning \[s\].
    pub fn seconds(&self) -> f64 {
        self.0.value()
    }

    /// Returns the clock `h` \[s\] later.
    pub fn after(mut self, h: f64) -> Self {
        self.0.add(h);
        self
    }

    /// The state of the clock.
    pub fn parts(&self) -> [f64; 2] {
        self.0.parts()
    }
}
