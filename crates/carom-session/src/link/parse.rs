//! Reads links from addresses.

use std::str::FromStr;
use std::sync::Arc;

use carom_scene::Override;
use percent_encoding::percent_decode_str;

use super::camera::LinkCamera;
use super::error::{LinkError, brief_problem, quoted};
use super::packed::unpack;
use super::rule::{named_rule, rule_override};
use super::run::{Beside, Link, LinkSource, checked_goal, checked_moves};
use super::time::checked_time;
use super::written;
use crate::change::PastChange;

/// Values of the parts that may occur once.
#[derive(Default)]
struct Once<'a> {
    scene: Option<&'a str>,
    file: Option<&'a str>,
    name: Option<&'a str>,
    rule: Option<&'a str>,
    edits: Option<&'a str>,
    beside: Option<&'a str>,
    beside_edits: Option<&'a str>,
    t: Option<&'a str>,
    camera: Option<&'a str>,
    goal: Option<&'a str>,
    moves: Option<&'a str>,
}

impl Link {
    /// Reads a link: a whole address, or the part of it after `#`.
    ///
    /// # Errors
    /// [`LinkError`], except for errors in the scene, which [`Self::open`] returns.
    pub fn parse(text: &str) -> Result<Self, LinkError> {
        link(text)
    }
}

impl FromStr for Link {
    type Err = LinkError;

    fn from_str(text: &str) -> Result<Self, LinkError> {
        Self::parse(text)
    }
}

/// Reads a link: a whole address, or the part of it after `#`.
fn link(text: &str) -> Result<Link, LinkError> {
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
            "beside" => ("beside", &mut once.beside),
            "beside-edits" => ("beside-edits", &mut once.beside_edits),
            "t" => ("t", &mut once.t),
            "camera" => ("camera", &mut once.camera),
            "goal" => ("goal", &mut once.goal),
            "moves" => ("moves", &mut once.moves),
            "set" => {
                overrides.push(decoded("set", value)?.parse::<Override>()?);
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
    let changes =
        Arc::new(once.edits.map(|it| edits("edits", it)).transpose()?.unwrap_or_default());
    Ok(Link {
        source: source(&once)?,
        overrides,
        beside: beside(&once, &changes)?,
        changes,
        time: once.t.map(time).transpose()?,
        camera: once.camera.map(camera).transpose()?,
        goal: once.goal.map(goal).transpose()?,
        moves: once.moves.map(moves).transpose()?,
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

/// Reads the second run, whose changes are those of the first unless the link has others.
fn beside(once: &Once, first: &Arc<Vec<PastChange>>) -> Result<Option<Beside>, LinkError> {
    let Some(rule) = once.beside else {
        return if once.beside_edits.is_some() { Err(LinkError::EditsOfNoRun) } else { Ok(None) };
    };
    let rule = named_rule("beside", rule)?;
    let own = once.beside_edits.map(|it| edits("beside-edits", it)).transpose()?;
    Ok(Some(Beside { rule, changes: own.map_or_else(|| first.clone(), Arc::new) }))
}

fn edits(part: &'static str, packed: &str) -> Result<Vec<PastChange>, LinkError> {
    let text = unpacked(part, packed)?;
    written::from_toml(&text)
        .map_err(|problem| LinkError::Edits { problem: brief_problem(&problem) })
}

fn time(text: &str) -> Result<f64, LinkError> {
    let seconds = text.parse().map_err(|_| LinkError::Time { found: quoted(text) })?;
    checked_time(seconds)
}

fn camera(text: &str) -> Result<LinkCamera, LinkError> {
    LinkCamera::read(&decoded("camera", text)?)
}

fn goal(text: &str) -> Result<f64, LinkError> {
    let goal = text.parse().map_err(|_| LinkError::Goal { found: quoted(text) })?;
    checked_goal(goal)
}

fn moves(packed: &str) -> Result<Arc<str>, LinkError> {
    checked_moves(&unpacked("moves", packed)?)
}

fn unpacked(part: &'static str, packed: &str) -> Result<String, LinkError> {
    unpack(packed).map_err(|source| LinkError::Packed { part, source })
}

fn decoded(part: &'static str, text: &str) -> Result<String, LinkError> {
    let decoded = percent_decode_str(text).decode_utf8();
    Ok(decoded.map_err(|_| LinkError::NoText { part })?.into_owned())
}
