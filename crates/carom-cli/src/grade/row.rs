//! Result of a run.

use std::path::PathBuf;

use carom_grade::Verdict;
use serde::Serialize;

/// Result of a run.
#[derive(Debug, Serialize)]
pub struct Row {
    /// File of the run.
    pub run: PathBuf,
    /// Result of grading.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub verdict: Option<Verdict>,
    /// Why the run cannot be graded.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error: Option<String>,
}
