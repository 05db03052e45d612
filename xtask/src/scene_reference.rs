//! The reference of scene fields in Markdown, made from the JSON Schema of scene files.

use std::collections::VecDeque;
use std::fs;

use serde_json::{Map, Value};

use crate::documents;
use crate::shell::{Outcome, root};

const SCHEMA: &str = "crates/carom-scene/scenes/scene.schema.json";
const REFERENCE: &str = "crates/carom-scene/scenes/fields.md";
const OPENING: &str = "\
# Fields of scene files

Every field of a [scene file](../../../docs/scenes.md), with its unit, range and default. `cargo xtask schema` makes this page from
the [JSON Schema](scene.schema.json).
";
/// The section of the file itself, and where the schema keeps those of all others.
const FILE: &str = "Scene";
const TYPES: &str = "$defs";

/// Writes the reference.
pub fn write() -> Outcome {
    fs::write(root().join(REFERENCE), current()?).map_err(|error| format!("{REFERENCE}: {error}"))
}

/// Refuses a reference that differs from the schema.
pub fn check() -> Outcome {
    if documents::text(REFERENCE)? == current()? {
        return Ok(());
    }
    Err(format!("{REFERENCE} differs from {SCHEMA}: run `cargo xtask schema`"))
}

fn current() -> Outcome<String> {
    let schema = serde_json::from_str(&documents::text(SCHEMA)?);
    Ok(reference(&schema.map_err(|error| format!("{SCHEMA}: {error}"))?))
}

/// The page of a schema: a section for the file, then one for each type in the order in which the
/// sections before name it.
fn reference(schema: &Value) -> String {
    let mut page = OPENING.to_owned();
    let mut waiting = VecDeque::from([FILE.to_owned()]);
    let mut written: Vec<String> = Vec::new();
    while let Some(name) = waiting.pop_front() {
        if written.contains(&name) {
            continue;
        }
        let section = if name == FILE { schema } else { &schema[TYPES][&name] };
        page += &format!("\n## {name}\n\n{}\n\n", description(section));
        page += &fields(section, "");
        page += &variants(section).iter().filter_map(variant).collect::<String>();
        collect_types(section, &mut waiting);
        written.push(name);
    }
    page
}

/// A line for each field of an object, with the fields of those that have no section of their own.
fn fields(object: &Value, indent: &str) -> String {
    let required = object["required"].as_array().cloned().unwrap_or_default();
    let mut text = String::new();
    for (name, value) in object["properties"].as_object().unwrap_or(&Map::new()) {
        let note = match default(value) {
            _ if required.contains(&Value::from(name.as_str())) => " (required)".to_owned(),
            Some(default) => format!(" (default `{default}`)"),
            None => String::new(),
        };
        let types: String = types(value).iter().map(|it| link(it)).collect();
        text += &format!("{indent}- `{name}`: {}{types}{note}\n", description(value));
        text += &fields(value, &format!("{indent}  "));
    }
    text
}

/// The line of one form that a value may have, with its fields; none of what is no form.
fn variant(form: &Value) -> Option<String> {
    if let Some(text) = form["const"].as_str() {
        return Some(format!("- `\"{text}\"`: {}\n", description(form)));
    }
    if let Some((name, value)) = form["properties"].as_object().and_then(|it| it.iter().next()) {
        let types: String = types(value).iter().map(|it| link(it)).collect();
        let first = format!("- `{name}`: {}{types}\n", description(form));
        return Some(first + &fields(value, "  "));
    }
    let types: String = types(form).iter().map(|it| link(it)).collect();
    form.get("description").map(|_| format!("- {}{types}\n", description(form)))
}

/// The forms that a value may have.
fn variants(value: &Value) -> Vec<Value> {
    let forms = ["oneOf", "anyOf"].into_iter().filter_map(|key| value[key].as_array());
    forms.flatten().cloned().collect()
}

/// The types with sections that a field holds.
fn types(value: &Value) -> Vec<String> {
    let own = value["$ref"].as_str().and_then(|it| it.rsplit('/').next()).map(str::to_owned);
    let inner = variants(value).into_iter().chain(value.get("items").cloned());
    own.into_iter().chain(inner.flat_map(|it| types(&it))).collect()
}

/// Adds every type that a section names.
fn collect_types(value: &Value, found: &mut VecDeque<String>) {
    match value {
        Value::Object(object) => {
            let own = object.get("$ref").and_then(Value::as_str);
            found.extend(own.and_then(|it| it.rsplit('/').next()).map(str::to_owned));
            let inner = object.iter().filter(|(key, _)| *key != TYPES);
            inner.for_each(|(_, inner)| collect_types(inner, found));
        }
        Value::Array(values) => values.iter().for_each(|it| collect_types(it, found)),
        _ => {}
    }
}

/// A default that a reader can use: a number, a word or a few numbers.
fn default(value: &Value) -> Option<String> {
    let default = value.get("default")?;
    let is_plain = match default {
        Value::Number(_) | Value::Array(_) => true,
        Value::String(text) => !text.is_empty(),
        Value::Bool(is_so) => *is_so,
        Value::Null | Value::Object(_) => false,
    };
    is_plain.then(|| default.to_string().replace(',', ", "))
}

fn description(value: &Value) -> String {
    let text = value["description"].as_str().unwrap_or_default();
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// A link to the section of a type.
fn link(name: &str) -> String {
    format!(" [{name}](#{})", name.to_lowercase())
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::reference;

    #[test]
    fn a_field_has_its_description_type_and_default() {
        let schema = json!({
            "description": "A scene.",
            "properties": {
                "balls": { "type": "array", "items": { "$ref": "#/$defs/Ball" }, "description": "All\nballs." },
                "time": { "description": "In s.", "default": 10.0 },
            },
            "required": ["balls"],
            "$defs": { "Ball": { "description": "A ball.", "oneOf": [
                { "const": "hollow", "description": "Empty." },
                { "properties": { "full": { "properties": { "mass": { "description": "In kg." } } } },
                  "description": "Full." },
                { "required": ["mass"] },
            ] } },
        });
        let page = reference(&schema);
        let expected = "\
## Scene

A scene.

- `balls`: All balls. [Ball](#ball) (required)
- `time`: In s. (default `10.0`)

## Ball

A ball.

- `\"hollow\"`: Empty.
- `full`: Full.
  - `mass`: In kg.
";
        assert!(page.ends_with(expected), "{page}");
    }
}
