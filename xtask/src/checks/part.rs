//! A part of the checks.

use crate::shell::Outcome;

/// A part of the checks: it runs by itself, and one time is printed for it.
pub struct Part {
    pub name: &'static str,
    /// Parts that run before it where they run at all: it builds on what they leave.
    pub after: &'static [&'static str],
    pub reads: Reads,
    /// Whether it mostly waits, for the clock of a browser: it runs beside those that compute.
    pub mostly_waits: bool,
    pub run: fn() -> Outcome,
}

impl Part {
    /// Returns a part that computes all the time.
    pub const fn new(
        name: &'static str,
        after: &'static [&'static str],
        reads: Reads,
        run: fn() -> Outcome,
    ) -> Self {
        Self { name, after, reads, mostly_waits: false, run }
    }

    /// Returns this part as one that mostly waits.
    pub const fn mostly_waiting(mut self) -> Self {
        self.mostly_waits = true;
        self
    }
}

/// What the outcome of a part depends on.
pub enum Reads {
    /// Every file of the repository.
    Everything,
    /// Packages of the workspace with all that they depend on, and files whose paths begin so.
    Some { packages: &'static [&'static str], paths: &'static [&'static str] },
}
