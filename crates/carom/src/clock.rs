use crate::sum::Sum;

/// The time of a world: a sum of step lengths that does not drift, however many there are.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Clock(Sum);

impl Clock {
    /// Time since the beginning \[s\].
    pub fn seconds(&self) -> f64 {
        self.0.value()
    }

    pub fn advance(&mut self, h: f64) {
        self.0.add(h);
    }
}
