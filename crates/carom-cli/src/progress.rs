//! How far a long command has come.

use std::io::{self, IsTerminal};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// What takes less than this shows no progress bar.
const PATIENCE: Duration = Duration::from_secs(1);

/// A progress bar on a terminal; none where the output is no terminal.
pub struct Progress {
    bar: ProgressBar,
    began: Instant,
}

impl Progress {
    /// A bar for so many frames.
    pub fn new(frames: u64) -> Self {
        let style = ProgressStyle::with_template("{wide_bar} {msg}, {eta} left");
        let bar = ProgressBar::with_draw_target(Some(frames), ProgressDrawTarget::hidden());
        bar.set_style(style.unwrap_or(ProgressStyle::default_bar()));
        Self { bar, began: Instant::now() }
    }

    /// A frame is done, at this time of the scene \[s\].
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
