//! The JSON Schema of scene files, for editors.

use crate::shell::{Outcome, cargo_with};

/// Writes it anew; a test in `carom-scene` tells when that is due.
pub fn write() -> Outcome {
    let test = ["test", "--quiet", "--package", "carom-scene", "--test", "scenes", "the_committed"];
    cargo_with(&test, &[("CAROM_WRITE_SCHEMA", "1")])
}
