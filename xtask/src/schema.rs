//! The JSON Schema of scene files, for editors, and the reference of their fields, for readers.

use crate::shell::{Outcome, cargo_with};
use crate::{parts, scene_reference};

/// Writes both, and the classes of Python, from the scene types; a test in `carom-scene` and the lints fail if one is outdated.
pub fn write() -> Outcome {
    let test = [
        "test",
        "--quiet",
        "--profile",
        "ci",
        "--package",
        "carom-scene",
        "--test",
        "scenes",
        "the_committed",
    ];
    cargo_with(&test, &[("CAROM_WRITE_SCHEMA", "1")])?;
    scene_reference::write()?;
    parts::write()
}
