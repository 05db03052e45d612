//! Errors of imports, with their places in the file.

use std::path::{Path, PathBuf};

use carom_scene::{SceneError, legible};
use thiserror::Error;

/// Longest quotation of a file in an error \[characters\].
const LONGEST: usize = 300;

/// Why a file cannot be imported.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ImportError {
    /// A file cannot be read.
    #[error("cannot read {path}: {source}", path = .path.display())]
    Unreadable {
        /// Path of the file.
        path: PathBuf,
        /// Error of the operating system.
        source: std::io::Error,
    },
    /// The content of a file is invalid.
    #[error(
        "{path}: {place}: {problem}",
        path = .path.display(),
        place = legible(.place, LONGEST),
        problem = legible(.problem, LONGEST)
    )]
    Malformed {
        /// Path of the file.
        path: PathBuf,
        /// Place in the file, such as `nodes[3].mesh`, with the line in a text.
        place: String,
        /// What is wrong at that place.
        problem: String,
    },
    /// The imported scene is invalid.
    #[error("{path}: {source}", path = .path.display())]
    Scene {
        /// Path of the file.
        path: PathBuf,
        /// What is wrong with the scene.
        source: Box<SceneError>,
    },
}

/// An error at a place of the JSON.
#[derive(Debug)]
pub(super) struct Malformed {
    pub place: String,
    pub problem: String,
}

impl Malformed {
    /// Creates an error at a place.
    pub fn at(place: impl Into<String>, problem: impl Into<String>) -> Self {
        Self { place: place.into(), problem: problem.into() }
    }

    /// Converts to the error of a file.
    pub fn in_file(self, path: &Path) -> ImportError {
        let Self { place, problem } = self;
        ImportError::Malformed { path: path.to_path_buf(), place, problem }
    }
}
