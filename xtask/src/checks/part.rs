//! A part of the checks.

use crate::shell::Outcome;

/// A part of the checks: it runs by itself, and one time is printed for it.
pub struct Part {
    pub name: &'static str,
    /// Parts that run before it where they run at all: it builds on what they leave.
    pub after: &'static [&'static str],
    pub reads: Reads,
    pub run: fn() -> Outcome,
}

/// What the outcome of a part depends on.
pub enum Reads {
    /// Every file of the repository.
    Everything,
    /// Packages of the workspace with all that they depend on, and files whose paths begin so.
    Some { packages: &'static [&'static str], paths: &'static [&'static str] },
}
