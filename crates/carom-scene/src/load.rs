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
    /// `None` takes the field out.
    value: Option<Value>,
}

impl std::str::FromStr for Override {
    type Err = SceneError;

    /// Parses `path=value`: names and indices, as in `emitters.0.period` or `emitters[0].period`,
    /// then a value in TOML. A word that is no TOML value is taken as a string; `none` takes the
    /// field out of the scene.
    fn from_str(text: &str) -> Result<Self, SceneError> {
        let (path, value) = text
            .split_once('=')
            .filter(|(path, _)| !path.trim().is_empty())
            .ok_or_else(|| bad_override(text, "write it as path=value"))?;
        if path.contains("..") || path.starts_with('.') || path.ends_with('.') {
            return Err(bad_override(text, "a name before or after a dot is missing"));
        }
        let path = segments(path.trim());
        if path.is_empty() {
            return Err(bad_override(text, "write it as path=value"));
        }
        let value = value.trim();
        if value == "none" {
            return Ok(Self { text: text.to_owned(), path, value: None });
        }
        let parsed = toml::from_str::<Table>(&format!("value = {value}"));
        let value = match parsed.ok().and_then(|mut table| table.remove("value")) {
            Some(value) => value,
            None => Value::String(value.to_owned()),
        };
        Ok(Self { text: text.to_owned(), path, value: Some(value) })
    }
}

fn bad_override(text: &str, problem: impl Into<String>) -> SceneError {
    SceneError::BadOverride { text: text.to_owned(), problem: problem.into() }
}

impl Override {
    fn apply(&self, scene: &mut Table) -> Result<(), SceneError> {
        let Some((last, way)) = self.path.split_last() else { return Ok(()) };
        let mut place = Place::Table(scene);
        for (i, name) in way.iter().enumerate() {
            let next = self.path[i + 1].as_str();
            place = place.enter(name, next).map_err(|problem| bad_override(&self.text, problem))?;
        }
        place.set(last, self.value.clone()).map_err(|problem| bad_override(&self.text, problem))
    }

    /// Whether the field at `path` (like `emitters[0].period`) is part of what this changes, or
    /// the other way round.
    fn concerns(&self, path: &str) -> bool {
        let segments = segments(path);
        let shared = self.path.len().min(segments.len());
        shared > 0 && self.path[..shared] == segments[..shared]
    }
}

/// Somewhere in a scene that has fields or elements.
enum Place<'a> {
    Table(&'a mut Table),
    Array(&'a mut Vec<Value>),
}

impl Place<'_> {
    /// What lies at `name`; a missing table is made, unless an element of it is asked for `next`.
    fn enter(self, name: &str, next: &str) -> Result<Self, String> {
        let value = match self {
            Self::Table(table) => {
                if !table.contains_key(name) && next.parse::<usize>().is_ok() {
                    return Err(format!("the scene has no `{name}`"));
                }
                table.entry(name).or_insert_with(|| Value::Table(Table::new()))
            }
            Self::Array(array) => element(array, name)?,
        };
        match value {
            Value::Table(table) => Ok(Self::Table(table)),
            Value::Array(array) => Ok(Self::Array(array)),
            _ => Err(format!("nothing lies below `{name}`")),
        }
    }

    fn set(self, name: &str, value: Option<Value>) -> Result<(), String> {
        match (self, value) {
            (Self::Table(table), Some(value)) => {
                table.insert(name.to_owned(), value);
            }
            (Self::Table(table), None) => {
                table.remove(name).ok_or_else(|| format!("the scene has no `{name}` there"))?;
            }
            (Self::Array(array), Some(value)) => *element(array, name)? = value,
            (Self::Array(array), None) => {
                element(array, name)?;
                array.remove(name.parse().unwrap_or_default());
            }
        }
        Ok(())
    }
}

fn element<'a>(array: &'a mut [Value], name: &str) -> Result<&'a mut Value, String> {
    let count = array.len();
    let index = name.parse::<usize>().map_err(|_| format!("`{name}` is no index"))?;
    array.get_mut(index).ok_or_else(|| match count {
        0 => "there are no elements".to_owned(),
        _ => format!("there is no element {index}, only 0 to {}", count - 1),
    })
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
        let original: Table =
            toml::from_str(text).map_err(|error| fault(source_name, None, "", error.message()))?;
        let mut table = original.clone();
        for changed in overrides {
            changed.apply(&mut table)?;
        }
        read(table).map_err(|problem| {
            // Without overrides, or if the file is wrong by itself, the file is to blame.
            let own =
                if overrides.is_empty() { Some(problem.clone()) } else { read(original).err() };
            if let Some(problem) = own {
                let line = line_of(&document, text, &problem);
                return fault(source_name, line, &problem.field, &problem.problem).into();
            }
            let mut cause: Vec<&Override> =
                overrides.iter().filter(|changed| changed.concerns(&problem.field)).collect();
            if cause.is_empty() {
                cause = overrides.iter().collect();
            }
            let cause: Vec<_> = cause.iter().map(|it| format!("--set {}", it.text)).collect();
            let fault = Box::new(fault(source_name, None, &problem.field, &problem.problem));
            SceneError::Overridden { overrides: cause.join(" "), fault }
        })
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

/// A scene from its table, or the first problem with it.
fn read(table: Table) -> Result<Scene, Problem> {
    let scene: Scene = serde_path_to_error::deserialize(Value::Table(table)).map_err(|error| {
        let path = error.path().to_string();
        let path = if path == "." { String::new() } else { path };
        Problem::new(path, error.into_inner().message().trim())
    })?;
    world::build(&scene)?;
    Ok(scene)
}

/// Names only, without the rest of the scene.
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
pub(crate) struct Heading {
    #[serde(default)]
    pub name: String,
    #[serde(default)]
    pub title: String,
}

impl Heading {
    /// The names in a scene file, even in one that is broken further down.
    pub fn of(text: &str) -> Self {
        let whole = toml::from_str(text);
        whole.unwrap_or_else(|_| {
            let is_name = |line: &&str| line.starts_with("name") || line.starts_with("title");
            let lines: Vec<&str> = text.lines().filter(is_name).collect();
            toml::from_str(&lines.join("\n")).unwrap_or_default()
        })
    }
}

fn fault(source_name: &str, line: Option<usize>, field: &str, problem: &str) -> Fault {
    Fault {
        source_name: source_name.to_owned(),
        line,
        field: field.to_owned(),
        problem: problem.lines().next().unwrap_or_default().to_owned(),
        nearest: suggestion(problem),
    }
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
