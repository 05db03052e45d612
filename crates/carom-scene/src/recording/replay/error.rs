//! Why a recording cannot be played.

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
        /// The file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// The first line does not name a column.
    #[error("{path}: there is no column \"{column}\"; is it a table of `carom run --out`?")]
    MissingColumn {
        /// The file.
        path: PathBuf,
        /// Its name.
        column: &'static str,
    },
    /// There is no frame in it.
    #[error("{path}: the table has no rows, so there is nothing to play")]
    Empty {
        /// The file.
        path: PathBuf,
    },
    /// Its last line has no end.
    #[error("{path}: the last line is cut short; was the run stopped while it was written?")]
    CutShort {
        /// The file.
        path: PathBuf,
    },
    /// A line makes no sense.
    #[error("{path}:{line}: {problem}")]
    Line {
        /// The file.
        path: PathBuf,
        /// From 1; the names of the columns are a line, too.
        line: u64,
        /// What is wrong.
        problem: LineProblem,
    },
    /// The scene makes no sense.
    #[error(transparent)]
    Scene(#[from] SceneError),
}

/// What is wrong with a line of a recording.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum LineProblem {
    /// A field is no number, or not a finite one.
    #[error("{column} must be a number, not \"{}\"", legible(.text, 60))]
    NotANumber {
        /// Its column.
        column: &'static str,
        /// The field.
        text: String,
    },
    /// The four numbers of an orientation are those of no rotation.
    #[error("qx, qy, qz, qw must be a rotation, not {0:?}")]
    NotARotation([f64; 4]),
    /// A line has more or fewer fields than the first one.
    #[error("{fields} fields where the first line has {expected}")]
    Fields {
        /// How many it has.
        fields: u64,
        /// How many it should have.
        expected: u64,
    },
    /// A line is longer than any of a recording.
    #[error("longer than {LONGEST_LINE} bytes, as no line of a recording is")]
    TooLong,
    /// What is there is not text.
    #[error("not text in UTF-8")]
    NotText,
    /// Times go back.
    #[error("the time {time} s comes after {last} s")]
    TimeGoesBack {
        /// Time of the line \[s\].
        time: f64,
        /// Time of the line before \[s\].
        last: f64,
    },
    /// Within a frame, balls do not come in order of their numbers.
    #[error("ball {ball} comes after ball {last} of the same time")]
    Order {
        /// Ball of the line.
        ball: u64,
        /// Ball of the line before.
        last: u64,
    },
    /// The scene has no such ball at that time.
    #[error("the scene has no ball {ball} at {time} s; is it another scene, or changed?")]
    UnknownBall {
        /// Its number.
        ball: u64,
        /// Time of the line \[s\].
        time: f64,
    },
    /// In the first frame, most balls are where they cannot have come from their start in the scene; this is the
    /// first one.
    #[error(
        "ball {ball} is {distance:.3} m from its start after {time} s, at the speed of {speed:.3} m/s; is it \
         another scene, or changed?"
    )]
    Elsewhere {
        /// Its number.
        ball: u64,
        /// From where it is in the scene at its start \[m\].
        distance: f64,
        /// Time of the line \[s\].
        time: f64,
        /// The larger one of its speeds at both \[m/s\].
        speed: f64,
    },
}
