//! Converts errors of grading.

use carom_grade::GradeError;

use crate::failure::Failure;

/// Converts an error of grading.
pub fn refused(error: GradeError) -> Failure {
    match error {
        GradeError::Scene(error) => error.into(),
        error => Failure::Usage(error.to_string()),
    }
}
