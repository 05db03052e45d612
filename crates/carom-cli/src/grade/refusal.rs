//! Why runs are not graded, and files not written.

use std::io;
use std::path::Path;

use carom_grade::GradeError;

use crate::failure::Failure;

/// Why a run is not graded.
pub fn refused(error: GradeError) -> Failure {
    match error {
        GradeError::Scene(error) => error.into(),
        error => Failure::Usage(error.to_string()),
    }
}

/// Why a file is not written.
pub fn unwritable(path: &Path, error: &io::Error) -> Failure {
    Failure::Fault(format!("cannot write {}: {error}", path.display()))
}
