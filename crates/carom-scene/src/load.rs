//! Scene files to scenes: parsing, overrides, and the place of every error.

use std::path::Path;

use serde::Deserialize;
use toml::de::{DeTable, DeValue};
use toml::{Spanned, Table, Value};

use crate::error::{Fault, Problem, SceneError, nearest};
use crate::scene::Scene;
use crate::world;

/// A changed value of a scene, like `emitters.0.max_spheres=100`.
#[derive(Debug, Clone, PartialEq)]
pub struct Override {
    text: String,
    path: Vec<String>,
    value: Value,
}

impl std::str::FromStr for Override {
    type Err = SceneError;

    /// Parses `path=value`: names and indices joined by dots, then a value in TOML; a word that
    /// is no TOML value is taken as a string.
    fn from_str(text: &str) -> Result<Self, SceneError> {
        let (path, value) = text
            .split_once('=')
            .filter(|(path, _)| !path.trim().is_empty())
            .ok_or_else(|| bad_override(text, "write it as path=value"))?;
        let path: Vec<String> = path.trim().split('.').map(str::to_owned).collect();
        if path.iter().any(String::is_empty) {
            return Err(bad_override(text, "a name between two dots is missing"));
        }
        let value = value.trim();
        let parsed = toml::from_str::<Table>(&format!("value = {value}"));
        let value = match parsed.ok().and_then(|mut table| table.remove("value")) {
            Some(value) => value,
            None => Value::String(value.to_owned()),
        };
        Ok(Self { text: text.to_owned(), path, value })
    }
}

fn bad_override(text: &str, problem: impl Into<String>) -> SceneError {
    SceneError::BadOverride { text: text.to_owned(), problem: problem.into() }
}

impl Override {
    fn apply(&self, table: &mut Table) -> Result<(), SceneError> {
        let (first, rest) = self.path.split_first().expect("parsed paths have a name");
        if rest.is_empty() {
            table.insert(first.clone(), self.value.clone());
            return Ok(());
        }
        let mut place = table.entry(first).or_insert_with(|| Value::Table(Table::new()));
        for name in rest {
            place = match place {
                Value::Table(table) => {
                    table.entry(name).or_insert_with(|| Value::Table(Table::new()))
                }
                Value::Array(array) => {
                    let count = array.len();
                    let element = name.parse().ok().and_then(|i: usize| array.get_mut(i));
                    element.ok_or_else(|| {
                        bad_override(&self.text, format!("there is no {name} among 0..{count}"))
                    })?
                }
                _ => return Err(bad_override(&self.text, format!("nothing lies below {name}"))),
            };
        }
        *place = self.value.clone();
        Ok(())
    }

    /// Whether the field at `path` (like `emitters[0].period`) is what this changes.
    fn concerns(&self, path: &str) -> bool {
        let segments = segments(path);
        let shared = self.path.len().min(segments.len());
        shared > 0 && self.path[..shared] == segments[..shared]
    }
}

impl Scene {
    /// Reads a scene from TOML; `source_name` is what errors call it.
    ///
    /// # Errors
    /// [`SceneError::Invalid`] for text that is no TOML, unknown fields, numbers that make no
    /// sense, and spheres that overlap at the start.
    pub fn from_toml(text: &str, source_name: &str) -> Result<Self, SceneError> {
        Self::from_toml_with(text, source_name, &[])
    }

    /// Reads a scene from TOML and changes some of its values.
    ///
    /// # Errors
    /// As [`Self::from_toml`], and [`SceneError::BadOverride`] for a path that leads nowhere.
    pub fn from_toml_with(
        text: &str,
        source_name: &str,
        overrides: &[Override],
    ) -> Result<Self, SceneError> {
        let document = DeTable::parse(text).map_err(|error| {
            let line = error.span().map(|span| line_at(text, span.start));
            fault(source_name, line, "", error.message())
        })?;
        let mut table: Table =
            toml::from_str(text).map_err(|error| fault(source_name, None, "", error.message()))?;
        for changed in overrides {
            changed.apply(&mut table)?;
        }
        let place = |problem: Problem| {
            let cause = overrides.iter().find(|o| o.concerns(&problem.field));
            match cause {
                Some(cause) => {
                    fault(&format!("--set {}", cause.text), None, &problem.field, &problem.problem)
                }
                None => {
                    let line = line_of(&document, text, &problem);
                    fault(source_name, line, &problem.field, &problem.problem)
                }
            }
        };
        let scene: Self =
            serde_path_to_error::deserialize(Value::Table(table)).map_err(|error| {
                let path = error.path().to_string();
                let path = if path == "." { String::new() } else { path };
                place(Problem::new(path, error.into_inner().message().trim()))
            })?;
        world::build(&scene).map_err(place)?;
        Ok(scene)
    }

    /// Reads a scene file.
    ///
    /// # Errors
    /// [`SceneError::Unreadable`], and as [`Self::from_toml_with`].
    pub fn from_file(path: &Path, overrides: &[Override]) -> Result<Self, SceneError> {
        let text = std::fs::read_to_string(path)
            .map_err(|source| SceneError::Unreadable { path: path.to_owned(), source })?;
        Self::from_toml_with(&text, &path.display().to_string(), overrides)
    }

    /// The same scene with some values changed.
    ///
    /// # Errors
    /// As [`Self::from_toml_with`].
    pub fn with(&self, overrides: &[Override]) -> Result<Self, SceneError> {
        Self::from_toml_with(&self.to_toml(), &self.name, overrides)
    }

    /// The scene as TOML, every default written out.
    pub fn to_toml(&self) -> String {
        toml::to_string(self).expect("a scene has only strings as keys")
    }
}

/// Names only, without the rest of the scene.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub(crate) struct Heading {
    pub name: String,
    #[serde(default)]
    pub title: String,
}

fn fault(source_name: &str, line: Option<usize>, field: &str, problem: &str) -> SceneError {
    Fault {
        source_name: source_name.to_owned(),
        line,
        field: field.to_owned(),
        problem: problem.lines().next().unwrap_or_default().to_owned(),
        nearest: suggestion(problem),
    }
    .into()
}

/// For "unknown field `x`, expected one of `y`, `z`": which of the expected is meant.
fn suggestion(message: &str) -> Option<String> {
    if !message.starts_with("unknown ") {
        return None;
    }
    let mut quoted = message.split('`').skip(1).step_by(2);
    let name = quoted.next()?;
    nearest(name, quoted)
}

/// `colliders[1].shape` as names and indices.
fn segments(path: &str) -> Vec<String> {
    path.split(['.', '[', ']']).filter(|part| !part.is_empty()).map(str::to_owned).collect()
}

/// Line of what a problem is about: the field itself, or the nearest thing around it that is
/// written in the file.
fn line_of(document: &Spanned<DeTable>, text: &str, problem: &Problem) -> Option<usize> {
    let mut path = segments(&problem.field);
    // "unknown field `x`" is reported at the table that holds x.
    path.extend(problem.problem.split('`').nth(1).map(str::to_owned));
    let (first, rest) = path.split_first()?;
    let (key, mut place) = document.get_ref().get_key_value(first.as_str())?;
    let mut line = line_at(text, key.span().start);
    for name in rest {
        let next = match place.get_ref() {
            DeValue::Table(table) => {
                table.get_key_value(name.as_str()).map(|(key, value)| (key.span(), value))
            }
            DeValue::Array(array) => {
                let element = name.parse().ok().and_then(|i: usize| array.get(i));
                element.map(|value| (value.span(), value))
            }
            _ => None,
        };
        let Some((span, value)) = next else { break };
        line = line_at(text, span.start);
        place = value;
    }
    Some(line)
}

fn line_at(text: &str, offset: usize) -> usize {
    text.as_bytes().iter().take(offset).filter(|&&byte| byte == b'\n').count() + 1
}
