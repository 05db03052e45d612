//! Values as scene files write them.

use serde::Serialize;

/// The name of a value that is one of several.
pub fn written(value: impl Serialize) -> String {
    let value = serde_json::to_value(value).unwrap_or_default();
    value.as_str().unwrap_or_default().to_owned()
}
