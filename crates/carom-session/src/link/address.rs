//! Links to addresses.

use percent_encoding::{AsciiSet, NON_ALPHANUMERIC, utf8_percent_encode};

use super::packed::pack;
use super::{Link, LinkSource, parse, written};

/// What is written as `%..` in a value: all but what people read easily, and no mail or chat takes
/// for the end of an address.
const ENCODED: &AsciiSet = &NON_ALPHANUMERIC
    .remove(b'-')
    .remove(b'.')
    .remove(b'_')
    .remove(b'~')
    .remove(b'=')
    .remove(b',')
    .remove(b':')
    .remove(b'/');

/// Decimals of a time that people read \[1\]: microseconds.
const READABLE_DECIMALS: usize = 6;

/// The part of an address after `#`.
pub fn fragment(link: &Link) -> String {
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
    let last_rule = overrides.iter().rposition(|text| parse::rule_of_override(text).is_some());
    for (i, text) in overrides.iter().enumerate() {
        match parse::rule_of_override(text).filter(|_| last_rule == Some(i)) {
            Some(rule) => parts.push(("rule", rule.to_owned())),
            None => parts.push(("set", encoded(text))),
        }
    }
    if !link.changes.is_empty() {
        parts.push(("edits", pack(&written::to_toml(&link.changes))));
    }
    if let Some(time) = link.time {
        parts.push(("t", number(time)));
    }
    let parts: Vec<String> = parts.iter().map(|(name, value)| format!("{name}={value}")).collect();
    parts.join("&")
}

fn encoded(text: &str) -> String {
    utf8_percent_encode(text, ENCODED).to_string()
}

/// A number in the fewest digits that give it back.
fn number(value: f64) -> String {
    let text = format!("{value:?}");
    text.strip_suffix(".0").map_or_else(|| text.clone(), str::to_owned)
}

/// A time \[s\] near this one that is easier to read, and as near to the same frame, where none is
/// shorter than `shortest_frame` \[s\].
pub fn readable(time: f64, shortest_frame: f64) -> f64 {
    let is_same = |rounded: &f64| (rounded - time).abs() < 0.25 * shortest_frame;
    let rounded = (0..=READABLE_DECIMALS).filter_map(|decimals| {
        let text = format!("{time:.decimals$}");
        text.parse().ok()
    });
    rounded.into_iter().find(is_same).unwrap_or(time)
}
