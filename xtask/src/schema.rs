//! The JSON Schema of scene files, for editors, and the reference of their fields, for readers.

use crate::scene_reference;
use crate::shell::{Outcome, cargo_with};

/// Writes both from the scene types; a test in `carom-scene` and the lints fail if one is outdated.
pub fn write() -> Outcome {
    let test = ["test", "--quiet", "--package", "carom-scene", "--test", "scenes", "the_committed"];
    cargo_with(&test, &[("CAROM_WRITE_SCHEMA", "1")])?;
    scene_reference::write()
}
