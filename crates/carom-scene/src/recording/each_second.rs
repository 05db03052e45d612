//! When a recording is put on the disk.

use std::io;
use std::time::{Duration, Instant};

/// Tells once a second that what was written is to be put on the disk: what stops a run then, even
/// the end of its process, costs the last second at most.
#[derive(Debug)]
pub(super) struct EachSecond {
    last: Instant,
}

impl EachSecond {
    pub fn new() -> Self {
        Self { last: Instant::now() }
    }

    /// Puts it there where the last time is a second ago.
    pub fn flush(&mut self, flush: impl FnOnce() -> io::Result<()>) -> io::Result<()> {
        if self.last.elapsed() < Duration::from_secs(1) {
            return Ok(());
        }
        flush()?;
        self.last = Instant::now();
        Ok(())
    }
}
