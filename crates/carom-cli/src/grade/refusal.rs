//! Converts errors of grading and of writing files.

use std::io;
use std::path::Path;

use carom_grade::GradeError;

use crate::failure::Failure;

/// Converts an error of grading.
pub fn refused(error: GradeError) -> Failure {
    match error {
        GradeError::Scene(error) => error.into(),
        error => Failure::Usage(error.to_string()),
    }
}

/// Converts an error of writing a file.
pub fn unwritable(path: &Path, error: &io::Error) -> Failure {
    Failure::Fault(format!("cannot write {}: {error}", path.display()))
}
