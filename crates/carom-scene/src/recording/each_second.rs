//! When the list of a series is put on the disk.

use std::time::{Duration, Instant};

/// Strikes once a second: what is written then is a second old at most when a process is killed.
#[derive(Debug)]
pub(super) struct EachSecond {
    last: Instant,
}

impl EachSecond {
    pub fn new() -> Self {
        Self { last: Instant::now() }
    }

    /// Whether the last time that it struck is a second ago.
    pub fn strikes(&mut self) -> bool {
        let strikes = self.last.elapsed() >= Duration::from_secs(1);
        if strikes {
            self.last = Instant::now();
        }
        strikes
    }
}
