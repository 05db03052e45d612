//! Promises that a case can break.

use std::time::Duration;

use thiserror::Error;

/// How a case breaks a promise.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Fault {
    /// Code panicked.
    #[error("panics: {0}")]
    Panic(String),
    /// The case took too long.
    #[error("takes {:.1} s", .0.as_secs_f64())]
    Slow(Duration),
    /// The case took too much memory.
    #[error("takes {} MB", .bytes / 1_000_000)]
    Memory {
        /// Largest memory use of the process so far \[bytes\].
        bytes: u64,
    },
    /// An error message is badly written.
    #[error("has an error {problem}: {error:?}")]
    Error {
        /// What is wrong with the message.
        problem: &'static str,
        /// The error.
        error: String,
    },
    /// A law of the engine, or of a reader, does not hold.
    #[error("{0}")]
    Law(String),
}

impl Fault {
    /// Returns whether the fault depends on what else the machine does: tests leave it to
    /// campaigns.
    pub fn is_limit(&self) -> bool {
        matches!(self, Self::Slow(_) | Self::Memory { .. })
    }

    /// Returns the text before any number: the same for all cases that break a promise in the same
    /// way.
    pub fn kind(&self) -> String {
        let said = self.to_string();
        said.split(|it: char| it.is_ascii_digit())
            .next()
            .unwrap_or_default()
            .trim_end_matches('-')
            .to_owned()
    }
}

/// Longest error \[characters\]: a few lines of a terminal.
const MOST_CHARACTERS: usize = 1000;

/// Checks that an error is one line that people can read, and that steers no terminal.
pub fn check_error(error: &str) -> Result<(), Fault> {
    let problem = if error.trim().is_empty() {
        "that says nothing"
    } else if error.contains('\n') {
        "of several lines"
    } else if error.chars().count() > MOST_CHARACTERS {
        "that is too long"
    } else {
        return check_line(error);
    };
    Err(Fault::Error { problem, error: error.chars().take(MOST_CHARACTERS).collect() })
}

/// Checks that a line steers no terminal.
pub fn check_line(line: &str) -> Result<(), Fault> {
    // Characters that turn the direction of text make it read otherwise than it is.
    let turns = |it: char| matches!(it, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    if !line.contains(|it: char| it.is_control() || turns(it)) {
        return Ok(());
    }
    let error = line.chars().take(MOST_CHARACTERS).collect();
    Err(Fault::Error { problem: "that steers the terminal", error })
}
