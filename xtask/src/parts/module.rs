//! A module of classes, aliases and what they import.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::Value;

use super::alias::alias;
use super::doc::{self, WIDTH};
use super::field::{Field, fields};
use super::layout::name_of;
use super::schema::Schema;
use crate::shell::Outcome;

const PACKAGE: &str = "carom._scene.parts";
/// Where names come from that the package does not define.
const FOREIGN: [(&str, &str); 10] = [
    ("Annotated", "typing"),
    ("ClassVar", "typing"),
    ("Literal", "typing"),
    ("Sequence", "collections.abc"),
    ("TypeAlias", "typing"),
    ("Whole", "carom._scene.checks"),
    ("dataclass", "dataclasses"),
    ("field", "dataclasses"),
    ("get_args", "typing"),
    ("math", ""),
];

/// The names that modules define, with the modules.
pub struct Names(BTreeMap<String, String>);

impl Names {
    /// Reads the modules of the layout.
    pub fn new(layout: &Value) -> Self {
        let mut names: BTreeMap<String, String> = FOREIGN
            .iter()
            .map(|(name, module)| ((*name).to_owned(), (*module).to_owned()))
            .collect();
        for module in layout["modules"].as_array().into_iter().flatten() {
            let file = module["file"].as_str().unwrap_or_default();
            for item in module["items"].as_array().into_iter().flatten() {
                names.insert(name_of(item).to_owned(), format!("{PACKAGE}.{file}"));
            }
        }
        Self(names)
    }

    /// Adds those of a module that is written by hand.
    pub fn add_python(&mut self, module: &str, text: &str) {
        for line in text.lines() {
            let line = line.trim_start_matches("def ").trim_start_matches("class ");
            let end = line.find(|letter: char| !letter.is_alphanumeric() && letter != '_');
            let Some(name) = end.map(|end| &line[..end]).filter(|it| !it.is_empty()) else {
                continue;
            };
            if ["(", ":", " ="].iter().any(|it| line[name.len()..].starts_with(it)) {
                self.0.insert(name.to_owned(), format!("{PACKAGE}.{module}"));
            }
        }
    }
}

/// The text of a module.
pub fn text(module: &Value, schema: &Schema, names: &Names) -> Outcome<String> {
    let mut body = String::new();
    let mut is_after_class = true;
    for item in module["items"].as_array().into_iter().flatten() {
        let is_class = item["class"].is_string();
        body += match (is_class, is_after_class) {
            (true, _) | (_, true) if !body.is_empty() || is_class => "\n\n",
            (_, true) => "\n",
            _ => "",
        };
        body += &if is_class { class(item, schema)? } else { alias(item, schema) };
        is_after_class = is_class;
    }
    let file = format!("{PACKAGE}.{}", module["file"].as_str().unwrap_or_default());
    let doc = module["doc"].as_str().unwrap_or_default();
    let imports = imports(&body, &file, names);
    Ok(format!(
        "\"\"\"{doc}\n\nMade by `cargo xtask parts` of the schema of scene files, which says what is to be changed.\n\
         \"\"\"\n\nfrom __future__ import annotations\n\n{imports}{body}"
    ))
}

fn class(item: &Value, schema: &Schema) -> Outcome<String> {
    let path = item["from"].as_str().unwrap_or_default();
    let object = schema.object(path)?;
    let fields = fields(&object, item, schema)?;
    let mut text = if item["kw_only"] == true {
        "@dataclass(frozen=True, kw_only=True)\n"
    } else {
        "@dataclass(frozen=True)\n"
    }
    .to_owned();
    text += &format!("class {}(Part):\n", name_of(item));
    let mut description = item["doc"].as_str().map_or_else(|| doc::of(object.doc), str::to_owned);
    if let Some(note) = item["note"].as_str() {
        description += &format!(" {note}");
    }
    let mut attributes = Vec::new();
    if !fields.is_empty() {
        attributes.push("    Attributes:".to_owned());
    }
    for field in &fields {
        let first = format!("        {}: ", field.name);
        attributes.extend(doc::wrapped(&field.doc, &first, "            "));
    }
    text += &doc::string(&description, "    ", &attributes);
    text += "\n\n";
    if let Some((_, tag)) = path.split_once('.') {
        text += &format!("    tag: ClassVar[str] = \"{tag}\"\n");
    }
    text += &fields.iter().map(line_of).collect::<String>();
    let checks: Vec<&str> =
        item["check"].as_array().into_iter().flatten().filter_map(Value::as_str).collect();
    if !checks.is_empty() {
        text += "\n    def __post_init__(self) -> None:\n        super().__post_init__()\n";
        text += &checks.iter().map(|check| format!("        {check}\n")).collect::<String>();
    }
    Ok(text)
}

fn line_of(field: &Field) -> String {
    let default = field.default.as_ref().map_or(String::new(), |default| format!(" = {default}"));
    format!("    {}: {}{default}\n", field.name, field.annotation)
}

/// The imports of the names that a body uses, in the order of isort.
fn imports(body: &str, own: &str, names: &Names) -> String {
    let mut used: BTreeMap<&str, BTreeSet<(u8, String)>> = BTreeMap::new();
    for name in words_of(&code_of(body)) {
        if let Some(module) = names.0.get(&name).filter(|module| *module != own) {
            used.entry(module).or_default().insert((rank(&name), name));
        }
    }
    let mut groups = [String::new(), String::new()];
    for (module, names) in &used {
        let names: Vec<&str> = names.iter().map(|it| it.1.as_str()).collect();
        let line = format!("from {module} import {}", names.join(", "));
        let text = if module.is_empty() {
            names.iter().map(|name| format!("import {name}\n")).collect()
        } else if line.chars().count() > WIDTH {
            let names: String = names.iter().map(|name| format!("    {name},\n")).collect();
            format!("from {module} import (\n{names})\n")
        } else {
            format!("{line}\n")
        };
        groups[usize::from(module.starts_with("carom"))] += &text;
    }
    let groups: Vec<&String> = groups.iter().filter(|it| !it.is_empty()).collect();
    groups.into_iter().cloned().collect::<Vec<_>>().join("\n")
}

/// Constants come before classes, and these before functions.
fn rank(name: &str) -> u8 {
    let is_constant = name.len() > 1 && name.chars().all(|it| it.is_uppercase() || it == '_');
    if is_constant { 0 } else { 2 - u8::from(name.starts_with(char::is_uppercase)) }
}

/// A body without its docstrings and other texts.
fn code_of(body: &str) -> String {
    body.split("\"\"\"")
        .step_by(2)
        .flat_map(|code| code.split('"').step_by(2))
        .collect::<Vec<_>>()
        .join(" ")
}

fn words_of(code: &str) -> BTreeSet<String> {
    let words = code.split(|letter: char| !letter.is_alphanumeric() && letter != '_');
    words.filter(|word| !word.is_empty()).map(str::to_owned).collect()
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::{Names, text};
    use crate::parts::schema::Schema;

    #[test]
    fn a_class_has_its_fields_their_meanings_and_what_they_import() {
        let schema = Schema::new(json!({ "$defs": { "Ball": {
            "description": "A ball. It rolls.",
            "required": ["radius"],
            "properties": {
                "radius": { "description": "Radius, in m, > 0", "type": "number", "exclusiveMinimum": 0.0 },
                "place": { "description": "Where.", "type": "array", "maxItems": 3 },
            },
        } } }));
        let module = json!({ "file": "balls", "doc": "Balls.", "items": [
            { "class": "Ball", "from": "Ball", "check": ["expect_room(self)"] },
            { "alias": "Any", "is": "Ball", "doc": "Any ball." },
        ] });
        let mut names = Names::new(&json!({ "modules": [module] }));
        names.add_python(
            "kinds",
            "ORIGIN: tuple = ()\nVector: TypeAlias = int\nPositive: TypeAlias = float\n",
        );
        names.add_python(
            "part",
            "class Part(Checked):\n    pass\ndef expect_room(part: Part) -> None:\n",
        );
        let expected = "\"\"\"Balls.\n\nMade by `cargo xtask parts` of the schema of scene files, which says what is \
            to be changed.\n\"\"\"\n\nfrom __future__ import annotations\n\nfrom dataclasses import dataclass\n\
            from typing import TypeAlias\n\nfrom carom._scene.parts.kinds import ORIGIN, Positive, Vector\n\
            from carom._scene.parts.part import Part, expect_room\n\n\n@dataclass(frozen=True)\nclass Ball(Part):\n    \
            \"\"\"A ball.\n\n    It rolls.\n\n    Attributes:\n        radius: Radius [m], > 0.\n        place: Where.\n    \
            \"\"\"\n\n    radius: Positive\n    place: Vector = ORIGIN\n\n    def __post_init__(self) -> None:\n        \
            super().__post_init__()\n        expect_room(self)\n\n\nAny: TypeAlias = Ball\n\"\"\"Any ball.\"\"\"\n";
        assert_eq!(text(&module, &schema, &names).unwrap(), expected);
    }
}
