//! A field of a class: its type, its default, what it means.

use serde_json::Value;

use super::doc;
use super::layout::words;
use super::schema::{self, Object, Schema};
use crate::shell::Outcome;

/// A field of a class, in the words of Python.
pub struct Field {
    pub name: String,
    pub annotation: String,
    /// The code of the default; nothing where the field must be given.
    pub default: Option<String>,
    pub doc: String,
}

/// The fields of a class in their order; those that must be given come first.
pub fn fields(object: &Object, class: &Value, schema: &Schema) -> Outcome<Vec<Field>> {
    let Some(properties) = object.body["properties"].as_object() else { return Ok(Vec::new()) };
    let order: Vec<&str> = words(class, "order");
    let without = words(class, "without");
    if let Some(name) = order.iter().find(|name| !properties.contains_key(**name)) {
        return Err(format!("{}: the schema has no field {name}", class["class"]));
    }
    let mut names: Vec<&String> =
        properties.keys().filter(|name| !without.contains(&name.as_str())).collect();
    names.sort_by_key(|name| order.iter().position(|it| it == name).unwrap_or(usize::MAX));
    let mut fields: Vec<Field> =
        names.into_iter().map(|name| field(name, object.body, class, schema)).collect();
    if class["kw_only"] != true {
        fields.sort_by_key(|field| field.default.is_some());
    }
    Ok(fields)
}

fn field(name: &str, body: &Value, class: &Value, schema: &Schema) -> Field {
    let property = &body["properties"][name];
    let own = |what: &str| class[what][name].as_str().map(str::to_owned);
    let kind = own("kinds").unwrap_or_else(|| kind_of(property, schema));
    let is_required = body["required"].as_array().into_iter().flatten().any(|it| it == name);
    let may_be_null = may_be_null(property);
    let default = own("defaults").or_else(|| {
        if is_required { None } else { Some(default_of(property, &kind, may_be_null)) }
    });
    let is_optional = default.as_deref() == Some("None");
    let annotation = if is_optional { format!("{kind} | None") } else { kind };
    let doc = own("docs").unwrap_or_else(|| doc::of(schema::doc(property)));
    Field { name: name.to_owned(), annotation, default, doc }
}

fn may_be_null(property: &Value) -> bool {
    let is_null = |it: &Value| it == "null" || it["type"] == "null";
    let lists = [&property["type"], &property["anyOf"]];
    lists.iter().any(|list| list.as_array().is_some_and(|list| list.iter().any(is_null)))
}

/// What a field takes, but for nothing at all.
fn kind_of(property: &Value, schema: &Schema) -> String {
    let inner = property["anyOf"].as_array().and_then(|it| it.iter().find_map(schema::reference));
    if let Some(name) = schema::reference(property).or(inner) {
        return kind_of_name(name, schema);
    }
    let types = &property["type"];
    let is = |kind: &str| {
        *types == kind || types.as_array().is_some_and(|it| it.iter().any(|it| it == kind))
    };
    if is("array") {
        if is("string") {
            return "Color".to_owned();
        }
        if let Some(name) = schema::reference(&property["items"]) {
            return format!("Sequence[{}]", kind_of_name(name, schema));
        }
        let is_whole = property["items"]["format"] == "uint32";
        return match (is_whole, property["maxItems"].as_u64()) {
            (true, Some(2)) => "TwoNumbers",
            (true, Some(3)) => "ThreeCounts",
            (true, _) => "Counts",
            (false, Some(2)) => "RadiusRange",
            (false, _) => "Vector",
        }
        .to_owned();
    }
    let bound = |name: &str| property[name].as_f64();
    let kind = if is("boolean") {
        "bool"
    } else if is("integer") {
        match (bound("minimum") == Some(1.0), property["format"] == "uint64") {
            (true, _) => "Count",
            (false, true) => "LargeNumber",
            (false, false) => "Number",
        }
    } else if is("number") {
        match (
            bound("minimum"),
            bound("exclusiveMinimum"),
            bound("maximum"),
            bound("exclusiveMaximum"),
        ) {
            (Some(1.0), _, Some(_), _) => "FrequencyRatio",
            (Some(-0.9), _, Some(_), _) => "NonAdditivity",
            (Some(_), _, Some(_), _) => "Restitution",
            (Some(_), ..) => "NonNegative",
            (_, Some(_), _, Some(_)) => "FieldOfView",
            (_, Some(_), ..) => "Positive",
            _ => "Finite",
        }
    } else {
        "str"
    };
    kind.to_owned()
}

/// What a name of the schema is in Python: a class, an alias, or the texts that it stands for.
fn kind_of_name(name: &str, schema: &Schema) -> String {
    match name {
        "Rotation" => "Quaternion".to_owned(),
        "Sphere" => "SizedSphere".to_owned(),
        "Boundary" => "Literal[\"open\"] | Periodic".to_owned(),
        "Stacking" | "WindBack" | "Zones" => literal(&schema.choices(name).unwrap_or_default()),
        _ => match name.strip_prefix("OneOrMore") {
            Some(one) => format!("{one} | Sequence[{one}]"),
            None => name.to_owned(),
        },
    }
}

/// The type of a choice among texts.
pub fn literal(choices: &[&str]) -> String {
    let quoted: Vec<String> = choices.iter().map(|it| format!("\"{it}\"")).collect();
    format!("Literal[{}]", quoted.join(", "))
}

/// The default of a field that need not be given: the schema's, or else that of its kind.
fn default_of(property: &Value, kind: &str, may_be_null: bool) -> String {
    if may_be_null {
        return "None".to_owned();
    }
    match &property["default"] {
        Value::Bool(is) => return if *is { "True" } else { "False" }.to_owned(),
        Value::Number(number) => return number.to_string(),
        Value::String(text) => return format!("\"{text}\""),
        Value::Array(numbers) => {
            let numbers: Vec<f64> = numbers.iter().filter_map(Value::as_f64).collect();
            return match numbers[..] {
                [0.0, 0.0, 0.0] => "ORIGIN".to_owned(),
                [0.0, 0.0, 0.0, 1.0] => "UNTURNED".to_owned(),
                _ => format!(
                    "({})",
                    numbers.iter().map(|it| format!("{it:?}")).collect::<Vec<_>>().join(", ")
                ),
            };
        }
        Value::Object(_) | Value::Null => {}
    }
    match kind {
        "Vector" => "ORIGIN".to_owned(),
        "Quaternion" => "UNTURNED".to_owned(),
        "bool" => "False".to_owned(),
        "str" => "\"\"".to_owned(),
        "NonNegative" | "Finite" => "0.0".to_owned(),
        _ if kind.contains("Sequence") => "()".to_owned(),
        _ if kind.chars().all(char::is_alphanumeric) => format!("field(default_factory={kind})"),
        _ => "None".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};

    use super::fields;
    use crate::parts::schema::{Object, Schema};

    fn told(properties: Value, required: Value, class: &Value) -> Vec<String> {
        let schema = Schema::new(json!({ "$defs": {
            "Zones": { "oneOf": [{ "const": "automatic" }, { "const": "never" }] },
        } }));
        let body = json!({ "properties": properties, "required": required });
        let found = fields(&Object { doc: "", body: &body }, class, &schema).unwrap();
        let line = |it: super::Field| {
            let default = it.default.map_or(String::new(), |default| format!(" = {default}"));
            format!("{}: {}{default}", it.name, it.annotation)
        };
        found.into_iter().map(line).collect()
    }

    #[test]
    fn types_and_ranges_are_kinds_of_python() {
        let properties = json!({
            "a": { "type": ["number", "null", "string"], "exclusiveMinimum": 0.0 },
            "b": { "type": ["number", "string"], "minimum": 0.0, "maximum": 1.0, "default": 0.5 },
            "c": { "type": "array", "items": { "type": ["number"] }, "maxItems": 3 },
            "d": { "type": ["array", "null", "string"], "maxItems": 3 },
            "e": { "type": ["integer", "string"], "minimum": 1 },
            "f": { "$ref": "#/$defs/Zones", "default": "never" },
            "g": { "$ref": "#/$defs/Rotation", "default": [0.0, 0.0, 0.0, 1.0] },
            "h": { "type": "boolean" },
        });
        let expected = [
            "e: Count",
            "a: Positive | None = None",
            "b: Restitution = 0.5",
            "c: Vector = ORIGIN",
            "d: Color | None = None",
            "f: Literal[\"automatic\", \"never\"] = \"never\"",
            "g: Quaternion = UNTURNED",
            "h: bool = False",
        ];
        assert_eq!(told(properties, json!(["e"]), &json!({})), expected);
    }

    #[test]
    fn a_layout_orders_fields_and_new_ones_come_last() {
        let number = json!({ "type": "number", "minimum": 0.0 });
        let properties = json!({ "a": number, "b": number, "c": number, "d": number });
        let class = json!({ "order": "c a", "defaults": { "c": "2.0" }, "without": "d" });
        let expected = ["c: NonNegative = 2.0", "a: NonNegative = 0.0", "b: NonNegative = 0.0"];
        assert_eq!(told(properties, json!([]), &class), expected);
    }
}
