//! The JSON Schema of scene files, for editors.

use crate::shell::{Outcome, cargo_with};

/// Rewrites the schema; a test in `carom-scene` fails if it is outdated.
pub fn write() -> Outcome {
    let test = ["test", "--quiet", "--package", "carom-scene", "--test", "scenes", "the_committed"];
    cargo_with(&test, &[("CAROM_WRITE_SCHEMA", "1")])
}
