//! The JSON Schema of scene files, for editors.

use crate::shell::{Outcome, root};

/// Writes it anew; a test in `carom-scene` tells when that is due.
pub fn write() -> Outcome {
    let path = root().join("crates/carom-scene/scenes/scene.schema.json");
    std::fs::write(&path, carom_scene::json_schema())
        .map_err(|error| format!("cannot write {}: {error}", path.display()))
}
