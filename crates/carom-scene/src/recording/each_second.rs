//! A timer for the list of files of a series.

use std::time::{Duration, Instant};

/// A timer of one second: a killed process loses at most the last second of the list.
#[derive(Debug)]
pub(super) struct EachSecond {
    last: Instant,
}

impl EachSecond {
    pub fn new() -> Self {
        Self { last: Instant::now() }
    }

    /// Returns `true` once a second has passed since it last did.
    pub fn strikes(&mut self) -> bool {
        let strikes = self.last.elapsed() >= Duration::from_secs(1);
        if strikes {
            self.last = Instant::now();
        }
        strikes
    }
}
