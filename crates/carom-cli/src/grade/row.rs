//! What came of a run.

use std::path::PathBuf;

use carom_grade::Verdict;
use serde::Serialize;

/// What came of a run.
#[derive(Debug, Serialize)]
pub struct Row {
    /// Its file.
    pub run: PathBuf,
    /// What grading says of it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub verdict: Option<Verdict>,
    /// Why it cannot be graded.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error: Option<String>,
}
