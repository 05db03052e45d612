//! Why a run cannot be graded.

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
        /// Which.
        path: PathBuf,
        /// Why.
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
        /// The file.
        path: PathBuf,
        /// Name of the column.
        column: String,
        /// What it should hold.
        what: &'static str,
        /// What `--columns` calls it.
        key: &'static str,
        /// Names of the columns that are there.
        there: String,
    },
    /// A line makes no sense.
    #[error("{path}:{line}: {problem}", path = .path.display(), problem = legible(.problem, LONGEST))]
    Malformed {
        /// The file.
        path: PathBuf,
        /// Line in it, from 1.
        line: u64,
        /// What is wrong there.
        problem: String,
    },
    /// The run as a whole cannot be graded.
    #[error("{path}: {problem}", path = .path.display())]
    Refused {
        /// Its file.
        path: PathBuf,
        /// Why.
        problem: String,
    },
    /// An assignment of columns makes no sense.
    #[error("{0}")]
    Columns(String),
    /// No mistake has this name.
    #[error("no mistake is called \"{name}\"{}", .nearest.map(|it| format!("; did you mean \"{it}\"?")).unwrap_or_default())]
    UnknownMistake {
        /// The name.
        name: String,
        /// The most similar name, if one is similar.
        nearest: Option<&'static str>,
    },
    /// The scene has what the rule of the course does not know.
    #[error("the course's rule does not know what the scene \"{scene}\" has: {what}")]
    NotOfTheCourse {
        /// Name of the scene.
        scene: String,
        /// What it has.
        what: String,
    },
    /// The scene makes no sense.
    #[error(transparent)]
    Scene(#[from] SceneError),
}
