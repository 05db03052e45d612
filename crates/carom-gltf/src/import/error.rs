//! Why a glTF file is not imported, and where in it.

use std::path::{Path, PathBuf};

use carom_scene::{SceneError, legible};
use thiserror::Error;

/// Longest quotation of a file in an error \[characters\].
const LONGEST: usize = 300;

/// Why a file is not imported.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ImportError {
    /// A file cannot be read.
    #[error("cannot read {path}: {source}", path = .path.display())]
    Unreadable {
        /// Which.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// A file says something that makes no sense.
    #[error(
        "{path}: {place}: {problem}",
        path = .path.display(),
        place = legible(.place, LONGEST),
        problem = legible(.problem, LONGEST)
    )]
    Malformed {
        /// Which file.
        path: PathBuf,
        /// Where in it, as `nodes[3].mesh`, with the line if it is a text.
        place: String,
        /// What is wrong there.
        problem: String,
    },
    /// What was read makes no scene that can run.
    #[error("{path}: {source}", path = .path.display())]
    Scene {
        /// The file.
        path: PathBuf,
        /// What is wrong with the scene.
        source: Box<SceneError>,
    },
}

/// Something that is wrong at a place of the JSON.
#[derive(Debug)]
pub(super) struct Malformed {
    pub place: String,
    pub problem: String,
}

impl Malformed {
    /// Something is wrong at this place.
    pub fn at(place: impl Into<String>, problem: impl Into<String>) -> Self {
        Self { place: place.into(), problem: problem.into() }
    }

    /// The error, of a file.
    pub fn in_file(self, path: &Path) -> ImportError {
        let Self { place, problem } = self;
        ImportError::Malformed { path: path.to_path_buf(), place, problem }
    }
}
