//! Errors of grading.

use std::io;
use std::path::PathBuf;

use carom_scene::{SceneError, legible};
use thiserror::Error;

/// Longest quotation of a table in an error \[characters\].
const LONGEST: usize = 300;

/// Why a run cannot be graded.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum GradeError {
    /// A file cannot be read.
    #[error("cannot read {path}: {source}", path = .path.display())]
    Unreadable {
        /// Path of the file.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
    /// A table lacks a column.
    #[error(
        "{path}: there is no column \"{column}\" for {what}; the columns are {there} \
         (--columns {key}=NAME names another)",
        path = .path.display(),
        there = legible(.there, LONGEST)
    )]
    MissingColumn {
        /// Path of the file.
        path: PathBuf,
        /// Name of the column.
        column: String,
        /// Content that the column should have.
        what: &'static str,
        /// Name of the column in `--columns`.
        key: &'static str,
        /// Names of the existing columns.
        there: String,
    },
    /// A line is invalid.
    #[error("{path}:{line}: {problem}", path = .path.display(), problem = legible(.problem, LONGEST))]
    Malformed {
        /// Path of the file.
        path: PathBuf,
        /// Number of the line, from 1.
        line: u64,
        /// What is wrong with the line.
        problem: String,
    },
    /// The run as a whole cannot be graded.
    #[error("{path}: {problem}", path = .path.display())]
    Refused {
        /// Path of the file.
        path: PathBuf,
        /// Reason.
        problem: String,
    },
    /// The argument `--columns` is invalid.
    #[error("{0}")]
    Columns(String),
    /// No mistake has this name.
    #[error("no mistake is called \"{name}\"{}", .nearest.map(|it| format!("; did you mean \"{it}\"?")).unwrap_or_default())]
    UnknownMistake {
        /// The unknown name.
        name: String,
        /// The most similar name, if one is similar.
        nearest: Option<&'static str>,
    },
    /// The scene has a part that the rule of the course does not support.
    #[error("the scene \"{scene}\" cannot be graded, because the course does not have {what}")]
    NotOfTheCourse {
        /// Name of the scene.
        scene: String,
        /// The unsupported part.
        what: String,
    },
    /// The scene is invalid.
    #[error(transparent)]
    Scene(#[from] SceneError),
}
