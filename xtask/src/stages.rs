//! Checks that the stages of the rules `exact` and `contact` have the same names in code, documents
//! and reports.

use crate::documents;
use crate::shell::Outcome;

/// For each rule, the document that describes its stages, and the code that runs them.
const RULES: [[&str; 2]; 2] = [
    ["docs/physics/exact.md", "crates/carom/src/rule/exact/mod.rs"],
    ["docs/physics/contact.md", "crates/carom/src/rule/contact/mod.rs"],
];
const REPORT: &str = "crates/carom/src/report.rs";

/// Compares the stages in the documents with those in the code and in the report.
pub fn check() -> Outcome {
    let mut known = Vec::new();
    for [document, code] in RULES {
        let (described, coded) =
            (stages(&documents::text(document)?), stages(&documents::text(code)?));
        if described.is_empty() || described != coded {
            return Err(format!(
                "{document} has the stages {described:?}, but {code} has {coded:?}"
            ));
        }
        known.extend(coded);
    }
    let report = documents::text(REPORT)?;
    let counted = counted_stages(&report);
    let unknown = counted.iter().find(|stage| !known.contains(stage));
    match unknown {
        Some(stage) => {
            Err(format!("{REPORT} counts work of the stage {stage:?}, which no rule has"))
        }
        None if counted.is_empty() => Err(format!("{REPORT} counts no work of stages")),
        None => Ok(()),
    }
}

/// Returns the bold names at the start of the items of the first such numbered list.
fn stages(text: &str) -> Vec<String> {
    let mut stages = Vec::new();
    for line in text.lines() {
        let line = line.trim_start_matches("//!").trim_start();
        let point = format!("{}. **", stages.len() + 1);
        if let Some((name, _)) = line.strip_prefix(&point).and_then(|rest| rest.split_once("**")) {
            stages.push(name.trim_end_matches('.').to_owned());
        }
    }
    stages
}

/// Returns the stage at the start of the documentation of each field of `StageCounts`.
fn counted_stages(report: &str) -> Vec<String> {
    let body = report.split_once("pub struct StageCounts {").map_or("", |(_, rest)| rest);
    let body = body.split_once("\n}").map_or("", |(body, _)| body);
    let mut is_first_line = true;
    let mut stages = Vec::new();
    for line in body.lines().map(str::trim) {
        match line.strip_prefix("/// ") {
            Some(text) if is_first_line => {
                stages.push(text.split_once(':').map_or(text, |(stage, _)| stage).to_owned());
                is_first_line = false;
            }
            Some(_) => {}
            None => is_first_line = true,
        }
    }
    stages
}

#[cfg(test)]
mod tests {
    use super::{counted_stages, stages};

    #[test]
    fn stages_are_the_bold_names_of_a_numbered_list() {
        let document =
            "# Rule\n\n1. **Begin.** It is\n   **so**.\n2. **Cell crossing** (`grid/`).\n";
        assert_eq!(stages(document), ["Begin", "Cell crossing"]);
        let code = "//! Rule\n//!\n//! 1. **Begin** (`frame`): x\n//! 2. **Cell crossing**: y\n";
        assert_eq!(stages(code), ["Begin", "Cell crossing"]);
        assert!(stages("1. no name\n2. **second**").is_empty());
    }

    #[test]
    fn a_field_counts_the_stage_that_its_documentation_begins_with() {
        let report = "pub struct StageCounts {\n    /// Predict: how\n    /// often: many.\n    \
                      pub predictions: u64,\n    /// Queue: events.\n    pub events: u64,\n}\n";
        assert_eq!(counted_stages(report), ["Predict", "Queue"]);
    }
}
