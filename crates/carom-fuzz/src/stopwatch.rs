//! Measures processor time, which does not depend on what else the machine does.

use std::fs;
use std::time::{Duration, Instant};

/// A measurement of the time that one thread computes, which must be the thread that reads it.
#[derive(Debug, Clone, Copy)]
pub struct Stopwatch {
    began: Instant,
    /// Processor time of the thread at the start; `None` where the system has no such figure.
    processor: Option<Duration>,
}

impl Stopwatch {
    /// Starts to measure.
    pub fn start() -> Self {
        Self { began: Instant::now(), processor: processor_time() }
    }

    /// Processor time since the start; time on the clock if the system has no such figure.
    pub fn elapsed(&self) -> Duration {
        let computed = self.processor.zip(processor_time());
        let clock = self.began.elapsed();
        computed.map_or(clock, |(from, to)| to.saturating_sub(from).min(clock))
    }

    /// Whether more than this time has passed.
    pub fn is_over(&self, time: Duration) -> bool {
        // The clock is read in less time than the system's file, and is never behind.
        self.began.elapsed() > time && self.elapsed() > time
    }
}

/// Processor time of this thread.
fn processor_time() -> Option<Duration> {
    let text = fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    text.split(' ').next()?.parse().ok().map(Duration::from_nanos)
}

#[cfg(test)]
mod tests {
    use std::thread;

    use super::*;

    #[test]
    fn waiting_takes_no_processor_time() {
        let stopwatch = Stopwatch::start();
        thread::sleep(Duration::from_millis(50));
        if stopwatch.processor.is_some() {
            assert!(stopwatch.elapsed() < Duration::from_millis(25), "{:?}", stopwatch.elapsed());
        }
    }
}
