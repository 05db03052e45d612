//! Names of values in scene files.

use serde::Serialize;

/// Returns the name of an enum's value in scene files.
pub fn written(value: impl Serialize) -> String {
    let value = serde_json::to_value(value).unwrap_or_default();
    value.as_str().unwrap_or_default().to_owned()
}
