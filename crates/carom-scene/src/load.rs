//! Scene files to scenes, and the place in the file of every error.

use std::path::Path;

use serde::Deserialize;
use toml::de::{DeTable, DeValue};
use toml::{Spanned, Table, Value};

use crate::error::{Fault, Problem, SceneError, segments};
use crate::overrides::Override;
use crate::parameters::{self, Parameter};
use crate::scene::Scene;
use crate::wording::{in_plain_words, suggestion, with_names};
use crate::world;

impl Scene {
    /// Reads a scene from TOML; `source_name` is what errors call it, and without its ending the name of
    /// a scene that has none.
    ///
    /// ```
    /// use carom_scene::Scene;
    ///
    /// let text = r#"
    /// name = "fall"
    /// spheres = [{ position = [0, 1, 0], radius = 0.5 }]
    /// [[forces]]
    /// gravity = { acceleration = [0, -9.81, 0] }
    /// "#;
    /// let scene = Scene::from_toml(text, "fall.toml")?;
    /// assert_eq!(scene.world()?.spheres().len(), 1);
    /// let mistyped = Scene::from_toml(&text.replace("radius", "radus"), "fall.toml").unwrap_err();
    /// assert!(mistyped.to_string().starts_with("fall.toml:3: spheres[0].radus: unknown field"));
    /// # Ok::<(), carom_scene::SceneError>(())
    /// ```
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
        let original = named(text, source_name)
            .map_err(|error| fault(source_name, None, "", error.message()))?;
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
            let cause: Vec<_> = cause.iter().map(|it| it.to_string()).collect();
            // What `--set` calls by its name alone may be meant for a parameter.
            let Problem { field, problem } = problem;
            let problem = with_names(problem, &field, parameter_names(&document));
            let fault = Box::new(fault(source_name, None, &field, &problem));
            SceneError::Overridden { overrides: cause.join(", "), fault }
        })
    }

    /// The numbers that a scene file gives names to (`[parameters]`), in its order, with some of its
    /// values changed. `parameters.NAME=VALUE` as an override changes one.
    ///
    /// # Errors
    /// As [`Self::from_toml_with`], for the parameters alone.
    pub fn parameters(
        text: &str,
        source_name: &str,
        overrides: &[Override],
    ) -> Result<Vec<Parameter>, SceneError> {
        let own = |problem: &str| fault(source_name, None, "", problem);
        let mut table = named(text, source_name).map_err(|error| own(error.message()))?;
        overrides.iter().try_for_each(|changed| changed.apply(&mut table))?;
        Ok(parameters::list(&table).map_err(|it| own(&format!("{}: {}", it.field, it.problem)))?)
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

/// A scene's table as it is written, with the name of the file where it has none.
pub(crate) fn named(text: &str, source_name: &str) -> Result<Table, toml::de::Error> {
    let mut table: Table = toml::from_str(text)?;
    let file = Path::new(source_name).file_stem().unwrap_or_default();
    if !(table.contains_key("name") || file.is_empty()) {
        table.insert("name".to_owned(), file.to_string_lossy().into_owned().into());
    }
    Ok(table)
}

/// The names of the parameters that a file has.
fn parameter_names<'a>(document: &'a Spanned<DeTable>) -> impl Iterator<Item = &'a str> {
    let table = document.get_ref().get(parameters::TABLE);
    let table = table.and_then(|value| value.get_ref().as_table());
    table.into_iter().flatten().map(|(name, _)| name.get_ref().as_ref())
}

/// A scene from its table, or the first problem with it.
pub(crate) fn read(mut table: Table) -> Result<Scene, Problem> {
    parameters::resolve(&mut table)?;
    let scene: Scene = serde_path_to_error::deserialize(Value::Table(table)).map_err(|error| {
        let path = error.path().to_string();
        let path = if path == "." { String::new() } else { path };
        let problem = in_plain_words(error.into_inner().message().trim());
        // The reader knows the fields of a scene, from which parameters have been taken out.
        let problem = with_names(problem, &path, [parameters::TABLE]);
        Problem::new(path, problem)
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

pub(crate) fn fault(source_name: &str, line: Option<usize>, field: &str, problem: &str) -> Fault {
    Fault {
        source_name: source_name.to_owned(),
        line,
        field: field.to_owned(),
        problem: problem.lines().next().unwrap_or_default().to_owned(),
        nearest: suggestion(problem),
    }
}

/// The place in the file of what a problem is about, as names and indices.
pub(crate) fn place_of(problem: &Problem) -> Vec<String> {
    let mut place = segments(&problem.field);
    // "unknown field `x`" is reported at the table that holds x; a field that is missing has no place.
    if !problem.problem.starts_with("missing field") {
        place.extend(problem.problem.split('`').nth(1).map(str::to_owned));
    }
    place
}

/// Line of what a problem is about: the field itself, or the nearest thing around it that is
/// written in the file.
pub(crate) fn line_of(document: &Spanned<DeTable>, text: &str, problem: &Problem) -> Option<usize> {
    let path = place_of(problem);
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

pub(crate) fn line_at(text: &str, offset: usize) -> usize {
    text.as_bytes().iter().take(offset).filter(|&&byte| byte == b'\n').count() + 1
}
