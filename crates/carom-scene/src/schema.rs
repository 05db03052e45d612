//! The JSON Schema of scene files, with which editors complete and check them.

use crate::scene::Scene;

/// The schema as JSON text, as it is committed in `scenes/scene.schema.json`.
pub fn json_schema() -> String {
    let schema = schemars::schema_for!(Scene);
    let mut text = serde_json::to_string_pretty(&schema).expect("a schema is plain JSON");
    text.push('\n');
    text
}
