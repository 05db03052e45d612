//! Names for types, and for values.

use serde_json::Value;

use super::doc::{self, WIDTH};
use super::field::literal;
use super::layout::{name_of, words};
use super::schema::{self, Schema};

/// The code and the documentation of a name: a choice among texts, a union of classes, or what the
/// layout says.
pub fn alias(item: &Value, schema: &Schema) -> String {
    if item["enum"].is_string() {
        return choice(item, schema);
    }
    let text = |what: &str| item[what].as_str().unwrap_or_default();
    let code = if item["union"].is_string() {
        union(name_of(item), &words(item, "of"))
    } else {
        let kind = item["type"].as_str().unwrap_or("TypeAlias");
        format!("{}: {kind} = {}", name_of(item), text("is"))
    };
    format!("{code}\n{}\n", doc::string(text("doc"), "", &[]))
}

/// A choice among texts, each with its meaning; those that the layout names come first.
fn choice(item: &Value, schema: &Schema) -> String {
    let (name, order) = (name_of(item), words(item, "order"));
    let named = schema.named(name);
    let place = |text: &str| order.iter().position(|it| *it == text).unwrap_or(usize::MAX);
    let mut variants: Vec<(&str, &str)> = named["oneOf"]
        .as_array()
        .into_iter()
        .flatten()
        .filter_map(|variant| Some((variant["const"].as_str()?, schema::doc(variant))))
        .collect();
    variants.sort_by_key(|variant| place(variant.0));
    let choices: Vec<&str> = variants.iter().map(|variant| variant.0).collect();
    let is = literal(&choices);
    let mut code = format!("{name}: TypeAlias = {is}");
    if code.chars().count() > WIDTH {
        let inner = is.trim_start_matches("Literal[").trim_end_matches(']');
        code = format!("{name}: TypeAlias = Literal[\n    {inner}\n]");
    }
    let meaning = |(text, meaning): &(&str, &str)| {
        doc::wrapped(&format!("- ``\"{text}\"``: {}", doc::of(meaning)), "", "  ")
    };
    let meanings: Vec<String> = variants.iter().flat_map(meaning).collect();
    format!("{code}\n{}\n", doc::string(&doc::of(schema::doc(named)), "", &meanings))
}

/// A union of classes.
fn union(name: &str, members: &[&str]) -> String {
    let line = format!("{name}: TypeAlias = {}", members.join(" | "));
    if line.chars().count() <= WIDTH {
        return line;
    }
    format!("{name}: TypeAlias = (\n    {}\n)", members.join("\n    | "))
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::alias;
    use crate::parts::schema::Schema;

    #[test]
    fn a_choice_says_what_each_text_means_in_the_order_of_the_layout() {
        let schema = Schema::new(json!({ "$defs": { "Side": { "description": "A side.", "oneOf": [
            { "const": "left", "description": "Towards -x" },
            { "const": "right", "description": "Towards +x" },
        ] } } }));
        let expected = "Side: TypeAlias = Literal[\"right\", \"left\"]\n\"\"\"A side.\n\n\
                        - ``\"right\"``: Towards +x.\n- ``\"left\"``: Towards -x.\n\"\"\"\n";
        assert_eq!(alias(&json!({ "enum": "Side", "order": "right" }), &schema), expected);
    }

    #[test]
    fn a_union_that_is_too_long_for_a_line_has_a_line_for_each() {
        let schema = Schema::new(json!({}));
        let short = json!({ "union": "A", "of": "B C", "doc": "Any." });
        assert_eq!(alias(&short, &schema), "A: TypeAlias = B | C\n\"\"\"Any.\"\"\"\n");
        let names = ["B".repeat(50), "C".repeat(50)];
        let long = json!({ "union": "A", "of": names.join(" "), "doc": "Any." });
        let expected =
            format!("A: TypeAlias = (\n    {}\n)\n\"\"\"Any.\"\"\"\n", names.join("\n    | "));
        assert_eq!(alias(&long, &schema), expected);
    }
}
