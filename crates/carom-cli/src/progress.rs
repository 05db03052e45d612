//! Progress of long commands.

use std::io::{self, IsTerminal};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Shorter commands show no progress bar.
const PATIENCE: Duration = Duration::from_secs(1);

/// A progress bar; hidden if the standard error stream is no terminal.
pub struct Progress {
    bar: ProgressBar,
    began: Instant,
}

impl Progress {
    /// Creates a bar for this number of frames.
    pub fn new(frames: u64) -> Self {
        let style = ProgressStyle::with_template("{wide_bar} {msg}, {eta} left");
        let bar = ProgressBar::with_draw_target(Some(frames), ProgressDrawTarget::hidden());
        bar.set_style(style.unwrap_or(ProgressStyle::default_bar()));
        Self { bar, began: Instant::now() }
    }

    /// Records that `frame` is complete, at `time` of the scene \[s\].
    pub fn show(&self, frame: u64, time: f64) {
        if self.bar.is_hidden() && self.began.elapsed() > PATIENCE && io::stderr().is_terminal() {
            self.bar.set_draw_target(ProgressDrawTarget::stderr());
        }
        self.bar.set_message(format!("{time:.2} s"));
        self.bar.set_position(frame);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
