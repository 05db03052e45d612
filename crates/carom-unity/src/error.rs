//! Errors of imports, with their places in files.

use std::path::{Path, PathBuf};
use std::rc::Rc;

use carom_scene::{SceneError, legible};
use thiserror::Error;

/// Longest quotation of a file in an error \[characters\].
const LONGEST: usize = 300;

/// Why a scene cannot be imported.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ImportError {
    /// A file or folder cannot be read.
    #[error("cannot read {path}: {source}", path = .path.display())]
    Unreadable {
        /// Path of the file or folder.
        path: PathBuf,
        /// Error of the operating system.
        source: std::io::Error,
    },
    /// The content of a file is invalid.
    #[error("{path}:{line}: {problem}", path = .path.display(), problem = legible(.problem, LONGEST))]
    Malformed {
        /// Path of the file.
        path: PathBuf,
        /// Number of the line, from 1.
        line: usize,
        /// What is wrong with the line.
        problem: String,
    },
    /// The scene as a whole cannot be imported.
    #[error("{path}: {problem}", path = .path.display(), problem = legible(.problem, LONGEST))]
    Refused {
        /// Path of the file.
        path: PathBuf,
        /// Reason.
        problem: String,
    },
    /// The imported scene is invalid.
    #[error("{path}: {source}", path = .path.display())]
    Scene {
        /// Path of the scene's file.
        path: PathBuf,
        /// What is wrong with the scene.
        source: Box<SceneError>,
    },
}

/// A line in a file.
#[derive(Debug, Clone)]
pub(crate) struct Place {
    /// The file.
    pub file: Rc<Path>,
    /// Number of the line, from 1.
    pub line: usize,
}

impl Place {
    /// Creates an error at this place.
    pub fn malformed(&self, problem: impl Into<String>) -> ImportError {
        ImportError::Malformed {
            path: self.file.to_path_buf(),
            line: self.line,
            problem: problem.into(),
        }
    }
}

/// Reads a text file of at most 64 MiB.
pub(crate) fn read_text(path: &Path) -> Result<String, ImportError> {
    const LARGEST: u64 = 64 << 20;
    let unreadable = |source| ImportError::Unreadable { path: path.to_path_buf(), source };
    let size = std::fs::metadata(path).map_err(unreadable)?.len();
    if size > LARGEST {
        let problem = "is larger than 64 MiB".to_owned();
        return Err(ImportError::Refused { path: path.to_path_buf(), problem });
    }
    let bytes = std::fs::read(path).map_err(unreadable)?;
    String::from_utf8(bytes).map_err(|error| {
        let before = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let line = 1 + before.iter().filter(|&&byte| byte == b'\n').count();
        let place = Place { file: path.into(), line };
        place.malformed(
            "is no text: in Unity set Asset Serialization to Force Text, and save the scene again",
        )
    })
}
