//! Errors of playing recordings.

use std::io;
use std::path::PathBuf;

use thiserror::Error;

use crate::error::SceneError;
use crate::legible::legible;
use crate::recording::short_lines::LONGEST_LINE;

/// Why a recording cannot be played.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ReplayError {
    /// The file cannot be read.
    #[error("cannot read {path}: {source}")]
    Unreadable {
        /// Path of the file.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
    /// The first line lacks a column.
    #[error("{path}: there is no column \"{column}\"; is it a table of `carom run --out`?")]
    MissingColumn {
        /// Path of the file.
        path: PathBuf,
        /// Name of the column.
        column: &'static str,
    },
    /// The file contains no frame.
    #[error("{path}: the table has no rows, so there is nothing to play")]
    Empty {
        /// Path of the file.
        path: PathBuf,
    },
    /// The last line is incomplete.
    #[error("{path}: the last line is cut short; was the run stopped while it was written?")]
    CutShort {
        /// Path of the file.
        path: PathBuf,
    },
    /// A line is invalid.
    #[error("{path}:{line}: {problem}")]
    Line {
        /// Path of the file.
        path: PathBuf,
        /// Number of the line, from 1; the header is line 1.
        line: u64,
        /// What is wrong.
        problem: LineProblem,
    },
    /// The scene is invalid.
    #[error(transparent)]
    Scene(#[from] SceneError),
}

/// What is wrong with a line of a recording.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum LineProblem {
    /// A field is not a finite number.
    #[error("{column} must be a number, not \"{}\"", legible(.text, 60))]
    NotANumber {
        /// Name of the column.
        column: &'static str,
        /// Text of the field.
        text: String,
    },
    /// The four numbers of an orientation are no rotation.
    #[error("qx, qy, qz, qw must be a rotation, not {0:?}")]
    NotARotation([f64; 4]),
    /// The line has more or fewer fields than the first one.
    #[error("{fields} fields where the first line has {expected}")]
    Fields {
        /// Number of fields in the line.
        fields: u64,
        /// Number of fields in the first line.
        expected: u64,
    },
    /// The line is longer than any line of a recording.
    #[error("longer than {LONGEST_LINE} bytes, the limit for a line of a recording")]
    TooLong,
    /// The line is not text.
    #[error("not text in UTF-8")]
    NotText,
    /// The time is earlier than in the line before.
    #[error("the time {time} s comes after {last} s")]
    TimeGoesBack {
        /// Time of the line \[s\].
        time: f64,
        /// Time of the line before \[s\].
        last: f64,
    },
    /// The balls of a frame are not in the order of their numbers.
    #[error("ball {ball} comes after ball {last} of the same time")]
    Order {
        /// Ball of the line.
        ball: u64,
        /// Ball of the line before.
        last: u64,
    },
    /// The scene has no such ball at this time.
    #[error("the scene has no ball {ball} at {time} s; is it another scene, or changed?")]
    UnknownBall {
        /// Number of the ball.
        ball: u64,
        /// Time of the line \[s\].
        time: f64,
    },
    /// In the first frame, most balls are too far from their start in the scene; the error
    /// describes the first of them.
    #[error(
        "ball {ball} is {distance:.3} m from its start after {time} s, at the speed of {speed:.3} m/s; is it \
         another scene, or changed?"
    )]
    Elsewhere {
        /// Number of the ball.
        ball: u64,
        /// Distance from the ball's position at the start of the scene \[m\].
        distance: f64,
        /// Time of the line \[s\].
        time: f64,
        /// The larger of its speeds at the start and in the frame \[m/s\].
        speed: f64,
    },
}
