//! Writes links as addresses.

use std::fmt;

use percent_encoding::{AsciiSet, NON_ALPHANUMERIC, utf8_percent_encode};

use super::packed::pack;
use super::rule::rule_of_override;
use super::run::{Link, LinkSource};
use super::written;

/// Characters that are written as `%..` in a value: all except those that are readable and that no
/// mail or chat program takes as the end of an address.
const ENCODED: &AsciiSet = &NON_ALPHANUMERIC
    .remove(b'-')
    .remove(b'.')
    .remove(b'_')
    .remove(b'~')
    .remove(b'=')
    .remove(b',')
    .remove(b':')
    .remove(b'/');

impl Link {
    /// Writes the link as the part of an address after `#`.
    pub fn to_fragment(&self) -> String {
        fragment(self)
    }
}

impl fmt::Display for Link {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.to_fragment())
    }
}

/// Writes the link as the part of an address after `#`.
fn fragment(link: &Link) -> String {
    let mut parts = Vec::new();
    match &link.source {
        LinkSource::BuiltIn(name) => parts.push(("scene", encoded(name))),
        LinkSource::File { name, text } => {
            parts.push(("file", pack(text)));
            if !name.is_empty() {
                parts.push(("name", encoded(name)));
            }
        }
    }
    let overrides: Vec<String> = link.overrides.iter().map(ToString::to_string).collect();
    let last_rule = overrides.iter().rposition(|text| rule_of_override(text).is_some());
    for (i, text) in overrides.iter().enumerate() {
        match rule_of_override(text).filter(|_| last_rule == Some(i)) {
            Some(rule) => parts.push(("rule", rule.to_owned())),
            None => parts.push(("set", encoded(text))),
        }
    }
    if !link.changes.is_empty() {
        parts.push(("edits", pack(&written::to_toml(&link.changes))));
    }
    if let Some(beside) = &link.beside {
        parts.push(("beside", beside.rule.name().to_owned()));
        if beside.changes != link.changes {
            parts.push(("beside-edits", pack(&written::to_toml(&beside.changes))));
        }
    }
    if let Some(time) = link.time {
        parts.push(("t", number(time)));
    }
    if let Some(camera) = &link.camera {
        parts.push(("camera", camera.written()));
    }
    if let Some(goal) = link.goal {
        parts.push(("goal", number(goal)));
    }
    if let Some(moves) = &link.moves {
        parts.push(("moves", pack(moves)));
    }
    let parts: Vec<String> = parts.iter().map(|(name, value)| format!("{name}={value}")).collect();
    parts.join("&")
}

fn encoded(text: &str) -> String {
    utf8_percent_encode(text, ENCODED).to_string()
}

/// Writes a number with the fewest digits that preserve it.
fn number(value: f64) -> String {
    let text = format!("{value:?}");
    text.strip_suffix(".0").map_or_else(|| text.clone(), str::to_owned)
}
