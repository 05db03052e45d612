//! What the schema of scene files says of an object.

use serde_json::Value;

use crate::shell::Outcome;

/// The schema.
pub struct Schema {
    root: Value,
}

/// An object of the schema: what it is, and its fields.
pub struct Object<'a> {
    pub doc: &'a str,
    pub body: &'a Value,
}

impl Schema {
    pub fn new(root: Value) -> Self {
        Self { root }
    }

    /// What a name stands for.
    pub fn named(&self, name: &str) -> &Value {
        &self.root["$defs"][name]
    }

    /// The object under a name, or one variant of it: `Sphere`, `Force.gravity`.
    pub fn object(&self, path: &str) -> Outcome<Object<'_>> {
        let missing = || format!("the schema has no {path}");
        let (name, tag) =
            path.split_once('.').map_or((path, None), |(name, tag)| (name, Some(tag)));
        let named = self.named(name);
        let Some(tag) = tag else {
            return named
                .is_object()
                .then(|| Object { doc: doc(named), body: named })
                .ok_or_else(missing);
        };
        let variants = named["oneOf"].as_array().ok_or_else(missing)?;
        let is_it =
            |variant: &&Value| variant["const"] == tag || variant["properties"].get(tag).is_some();
        let variant = variants.iter().find(is_it).ok_or_else(missing)?;
        let body = variant["properties"].get(tag).unwrap_or(variant);
        let body = reference(body).map_or(body, |name| self.named(name));
        // What may be written shorter is described by its fields.
        let whole = body["anyOf"].as_array().and_then(|it| it.iter().find_map(reference));
        let body = whole.map_or(body, |name| self.named(name));
        Ok(Object { doc: doc(variant), body })
    }

    /// The texts among which a name chooses, if it does.
    pub fn choices(&self, name: &str) -> Option<Vec<&str>> {
        let variants = self.named(name)["oneOf"].as_array()?;
        variants.iter().map(|variant| variant["const"].as_str()).collect()
    }
}

/// The documentation of a piece of the schema.
pub fn doc(value: &Value) -> &str {
    value["description"].as_str().unwrap_or_default()
}

/// The name that a piece of the schema refers to.
pub fn reference(value: &Value) -> Option<&str> {
    value["$ref"].as_str()?.strip_prefix("#/$defs/")
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::Schema;

    #[test]
    fn objects_are_found_by_name_and_variants_by_their_tags() {
        let schema = Schema::new(json!({ "$defs": {
            "A": { "description": "An A.", "properties": {} },
            "B": { "oneOf": [
                { "const": "none", "description": "Nothing." },
                { "description": "Other.", "properties": { "a": { "$ref": "#/$defs/A" } } },
            ] },
            "C": { "oneOf": [{ "const": "x" }, { "const": "y" }] },
        } }));
        assert_eq!(schema.object("A").unwrap().doc, "An A.");
        assert_eq!(schema.object("B.none").unwrap().doc, "Nothing.");
        let variant = schema.object("B.a").unwrap();
        assert_eq!((variant.doc, &variant.body["description"]), ("Other.", &json!("An A.")));
        assert!(schema.object("B.c").is_err());
        assert_eq!(schema.choices("C").unwrap(), ["x", "y"]);
        assert_eq!(schema.choices("B"), None);
    }
}
