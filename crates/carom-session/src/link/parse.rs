//! Addresses to links.

use std::sync::Arc;

use carom_scene::Override;
use carom_scene::scene::Rule;
use percent_encoding::percent_decode_str;

use super::error::LinkError;
use super::packed::unpack;
use super::{Link, LinkSource, written};

/// Names of the parts of a link.
pub const PARTS: [&str; 7] = ["scene", "file", "name", "set", "rule", "edits", "t"];

/// What an override that changes the rule begins with.
const RULE_PATH: &str = "simulation.rule=";

/// Longest quotation from a link in an error \[characters\].
const LONGEST_QUOTATION: usize = 40;

/// The values of a link as they are written, of those that come once.
#[derive(Default)]
struct Once<'a> {
    scene: Option<&'a str>,
    file: Option<&'a str>,
    name: Option<&'a str>,
    rule: Option<&'a str>,
    edits: Option<&'a str>,
    t: Option<&'a str>,
}

/// Reads a link: a whole address, or the part of it after `#`.
pub fn link(text: &str) -> Result<Link, LinkError> {
    let text = text.trim();
    let fragment = match text.split_once('#') {
        Some((_, fragment)) => fragment,
        None if is_address(text) => "",
        None => text,
    };
    let mut once = Once::default();
    let mut overrides = Vec::new();
    let mut parts = fragment.split('&').filter(|part| !part.is_empty()).peekable();
    parts.peek().ok_or(LinkError::Empty)?;
    for part in parts {
        let (name, value) = part.split_once('=').unwrap_or((part, ""));
        let (known, place) = match name {
            "scene" => ("scene", &mut once.scene),
            "file" => ("file", &mut once.file),
            "name" => ("name", &mut once.name),
            "rule" => ("rule", &mut once.rule),
            "edits" => ("edits", &mut once.edits),
            "t" => ("t", &mut once.t),
            "set" => {
                overrides.push(decoded("set", value)?.parse()?);
                continue;
            }
            _ => return Err(LinkError::Unknown { part: quoted(name) }),
        };
        if place.replace(value).is_some() {
            return Err(LinkError::Repeated { part: known });
        }
        if known == "rule" {
            overrides.push(rule_override(value)?);
        }
    }
    Ok(Link {
        source: source(&once)?,
        overrides,
        changes: Arc::new(once.edits.map(edits).transpose()?.unwrap_or_default()),
        time: once.t.map(time).transpose()?,
    })
}

/// Whether a text begins with the scheme of an address.
fn is_address(text: &str) -> bool {
    let scheme = text.split_once("://").map_or("", |(scheme, _)| scheme);
    !scheme.is_empty() && scheme.bytes().all(|it| it.is_ascii_alphanumeric())
}

fn source(once: &Once) -> Result<LinkSource, LinkError> {
    match (once.scene, once.file) {
        (None, None) => Err(LinkError::NoScene),
        (Some(_), Some(_)) => Err(LinkError::TwoScenes),
        (Some(_), None) if once.name.is_some() => Err(LinkError::NameOfNoFile),
        (Some(scene), None) => Ok(LinkSource::BuiltIn(decoded("scene", scene)?)),
        (None, Some(file)) => {
            let name = once.name.map(|name| decoded("name", name)).transpose()?;
            let text = unpacked("file", file)?;
            Ok(LinkSource::File { name: name.unwrap_or_default(), text })
        }
    }
}

fn edits(packed: &str) -> Result<Vec<crate::PastChange>, LinkError> {
    let text = unpacked("edits", packed)?;
    written::from_toml(&text).map_err(|problem| LinkError::Edits { problem })
}

fn time(text: &str) -> Result<f64, LinkError> {
    let seconds = text.parse().map_err(|_| LinkError::Time { found: quoted(text) })?;
    checked_time(seconds)
}

/// A time \[s\], if it is one.
pub fn checked_time(seconds: f64) -> Result<f64, LinkError> {
    if seconds >= 0.0 && seconds.is_finite() {
        // Not -0, which is a time as well as 0 but reads like none.
        Ok(seconds.abs())
    } else {
        Err(LinkError::Time { found: format!("{seconds:?}") })
    }
}

/// What `rule=` stands for.
pub fn rule_override(rule: &str) -> Result<Override, LinkError> {
    if !Rule::NAMES.contains(&rule) {
        return Err(LinkError::Rule { found: quoted(rule) });
    }
    Ok(format!("{RULE_PATH}{rule}").parse()?)
}

/// The rule that an override sets, if that is what it does in so many words.
pub fn rule_of_override(text: &str) -> Option<&str> {
    text.strip_prefix(RULE_PATH).filter(|rule| Rule::NAMES.contains(rule))
}

fn unpacked(part: &'static str, packed: &str) -> Result<String, LinkError> {
    unpack(packed).map_err(|source| LinkError::Packed { part, source })
}

fn decoded(part: &'static str, text: &str) -> Result<String, LinkError> {
    let decoded = percent_decode_str(text).decode_utf8();
    Ok(decoded.map_err(|_| LinkError::NoText { part })?.into_owned())
}

/// The beginning of what a link says.
fn quoted(text: &str) -> String {
    shortened(text, LONGEST_QUOTATION)
}

/// A text, or the beginning of one with more than `longest` characters.
pub fn shortened(text: &str, longest: usize) -> String {
    let mut shortened: String = text.chars().take(longest).collect();
    if shortened.len() < text.len() {
        shortened.push_str("...");
    }
    shortened
}
