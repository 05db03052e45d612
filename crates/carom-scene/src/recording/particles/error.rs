//! Errors of particle files.

use std::io;
use std::path::PathBuf;

use thiserror::Error;

use crate::error::SceneError;
use crate::legible::legible;

/// What is wrong at a place of a file.
#[derive(Debug)]
pub(super) struct Problem(pub String);

/// Most characters of a text of the file that a message shows.
const SHOWN: usize = 40;

/// Quotes a text of the file for a message.
pub(super) fn shown(text: &str) -> String {
    format!("\"{}\"", legible(text, SHOWN))
}

impl From<String> for Problem {
    fn from(text: String) -> Self {
        Self(text)
    }
}

impl From<&str> for Problem {
    fn from(text: &str) -> Self {
        Self(text.to_owned())
    }
}

/// Why a particle file cannot be read.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ParticleError {
    /// The file cannot be read.
    #[error("cannot read {path}: {source}")]
    Unreadable {
        /// Path of the file.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
    /// A line is wrong.
    #[error("{path}:{line}: {problem}")]
    Line {
        /// Path of the file.
        path: PathBuf,
        /// Number of the line, from 1.
        line: u64,
        /// What is wrong.
        problem: String,
    },
    /// A part of a binary file is wrong.
    #[error("{path}: {problem}")]
    Binary {
        /// Path of the file.
        path: PathBuf,
        /// Where, and what is wrong.
        problem: String,
    },
    /// The file has no frame with this number.
    #[error("{path} has no frame {frame}: its last whole frame is {last}")]
    NoFrame {
        /// Path of the file.
        path: PathBuf,
        /// The number, from 0.
        frame: u64,
        /// Number of the last whole frame.
        last: u64,
    },
    /// The file has no complete frame.
    #[error("{path} has no whole frame")]
    Empty {
        /// Path of the file.
        path: PathBuf,
    },
    /// The particles have no radius, or two.
    #[error("{path}: {problem}")]
    Radius {
        /// Path of the file.
        path: PathBuf,
        /// What is wrong.
        problem: &'static str,
    },
    /// The scene cannot be simulated.
    #[error("{path}: {source}")]
    Scene {
        /// Path of the file.
        path: PathBuf,
        /// What is wrong with the scene.
        source: Box<SceneError>,
    },
}

/// Why a frame is not read.
#[derive(Debug)]
pub(super) enum Fault {
    /// The file ends within it.
    CutShort,
    /// The last line read is wrong.
    Problem(Problem),
    Io(io::Error),
}

impl From<io::Error> for Fault {
    fn from(error: io::Error) -> Self {
        Self::Io(error)
    }
}

impl From<Problem> for Fault {
    fn from(problem: Problem) -> Self {
        Self::Problem(problem)
    }
}
