//! What the layout says in the same way of everything.

use serde_json::Value;

/// What a piece of a module is called, whatever it is.
pub fn name_of(item: &Value) -> &str {
    let kinds = ["class", "enum", "alias", "union", "constant"];
    kinds.iter().find_map(|kind| item[kind].as_str()).unwrap_or_default()
}

/// The names that stand under a word, with spaces between them.
pub fn words<'a>(item: &'a Value, list: &str) -> Vec<&'a str> {
    item[list].as_str().unwrap_or_default().split_whitespace().collect()
}
