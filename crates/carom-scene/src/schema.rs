//! JSON Schema of scene files, for completion and checks in editors.

use schemars::Schema;
use schemars::generate::SchemaSettings;
use schemars::transform::RecursiveTransform;
use serde_json::{Value, json};

use crate::color_text;
use crate::parameters;
use crate::scene::Scene;

/// Pattern of a string that is a formula.
const FORMULA: &str = "^=";
/// Pattern of a string that is a formula or a number with a unit.
const FORMULA_OR_QUANTITY: &str = "^(=|[-+]?[0-9.].*[^-+.0-9]$)";

/// Returns the schema as JSON text, as committed in `scenes/scene.schema.json`.
pub fn json_schema() -> String {
    let settings = SchemaSettings::default().with_transform(RecursiveTransform(allow_text));
    let mut schema = settings.into_generator().into_root_schema_for::<Scene>();
    add_properties(&mut schema);
    let mut text = serde_json::to_string_pretty(&schema).expect("a schema is plain JSON");
    text.push('\n');
    text
}

/// Allows formulas where numbers are allowed, units where fractions are allowed, and names of
/// colours.
fn allow_text(schema: &mut Schema) {
    allow_color_names(schema);
    let Some(types) = schema.get_mut("type") else { return };
    let mut all = match types.take() {
        Value::Array(all) => all,
        one => vec![one],
    };
    let has = |name: &str| all.iter().any(|it| it == name);
    let pattern = match [has("number"), has("integer")] {
        [true, _] => Some(FORMULA_OR_QUANTITY),
        [false, true] => Some(FORMULA),
        [false, false] => None,
    };
    if pattern.is_some() {
        all.push(json!("string"));
    }
    *types = if all.len() == 1 { all.remove(0) } else { Value::Array(all) };
    if let Some(pattern) = pattern {
        schema.insert("pattern".to_owned(), json!(pattern));
    }
}

/// Allows strings in colour fields, which otherwise are lists of three numbers.
fn allow_color_names(schema: &mut Schema) {
    let Some(Value::Object(properties)) = schema.get_mut("properties") else { return };
    let fields = properties.iter_mut().filter(|(name, _)| color_text::may_be_color(name));
    for (_, field) in fields.filter(|(_, field)| field["minItems"] == 3) {
        field["type"] = match field["type"].take() {
            Value::Array(types) => types.into_iter().chain([json!("string")]).collect(),
            one => json!([one, "string"]),
        };
    }
}

/// Adds the properties that are no fields of a scene, `parameters` and `include`: they are replaced
/// by what they stand for when a file is read.
fn add_properties(schema: &mut Schema) {
    let mut value = schemars::json_schema!({ "type": "number" });
    allow_text(&mut value);
    let table = json!({
        "description": "Numbers by name, for formulas. A text that begins with = may stand wherever a number may: \
                        radius = \"=2*r\". A parameter may have a unit, \"5 cm\", or be a formula of those before it.",
        "type": "object",
        "additionalProperties": value,
    });
    if let Some(Value::Object(properties)) = schema.get_mut("properties") {
        properties.insert(parameters::TABLE.to_owned(), table);
        let include = json!({
            "description": "Other scene files, a path or a list of paths. Their lists come before those of this file; \
                            single values of this file win.",
            "oneOf": [{ "type": "string" }, { "type": "array", "items": { "type": "string" } }],
        });
        properties.insert("include".to_owned(), include);
    }
}
