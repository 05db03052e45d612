//! Overrides: values of a scene that are changed from outside its file.

use toml::{Table, Value};

use crate::error::{SceneError, did_you_mean, nearest, segments};
use crate::parameters;

/// Most names and indices in a path: twice as many as the deepest field of a scene has. A text must
/// not exhaust the stack with nested tables.
const DEEPEST: usize = 16;

/// A new value for a field of a scene, such as `emitters.0.max_spheres=100`.
#[derive(Debug, Clone, PartialEq)]
pub struct Override {
    text: String,
    path: Vec<String>,
    /// The new value; `None` removes the field.
    value: Option<Value>,
}

impl std::str::FromStr for Override {
    type Err = SceneError;

    /// Parses `path=value`. The path consists of names and indices, as in `emitters.0.period` or
    /// `emitters[0].period`, or is the name of a parameter. The value is TOML; another word is
    /// taken as a string, and `none` removes the field.
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
        if path.len() > DEEPEST {
            return Err(bad_override(text, "no value of a scene is nested so deeply"));
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

impl std::fmt::Display for Override {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.text)
    }
}

impl Override {
    /// Applies the override to a scene.
    pub(crate) fn apply(&self, scene: &mut Table) -> Result<(), SceneError> {
        let path = self.path_in(scene);
        if let [parameters::TABLE, name] = path[..] {
            self.check_parameter(name, scene)?;
        }
        let Some((last, way)) = path.split_last() else { return Ok(()) };
        let mut place = Place::Table(scene);
        for (i, name) in way.iter().enumerate() {
            let next = path[i + 1];
            place = place.enter(name, next).map_err(|problem| bad_override(&self.text, problem))?;
        }
        place.set(last, self.value.clone()).map_err(|problem| bad_override(&self.text, problem))
    }

    /// Refuses a parameter that the scene does not have, because it would change nothing.
    fn check_parameter(&self, name: &str, scene: &Table) -> Result<(), SceneError> {
        let known = scene.get(parameters::TABLE).and_then(Value::as_table);
        if known.is_some_and(|it| it.contains_key(name)) {
            return Ok(());
        }
        let names = known.into_iter().flat_map(Table::keys).map(String::as_str);
        let nearest = did_you_mean(&nearest(name, names));
        let problem = format!("the scene has no parameter `{name}`{nearest}");
        Err(bad_override(&self.text, problem))
    }

    /// Returns the path in this scene. A name alone means a parameter, unless the scene has a field
    /// of that name.
    fn path_in(&self, scene: &Table) -> Vec<&str> {
        let path = self.path.iter().map(String::as_str);
        let parameters = scene.get(parameters::TABLE).and_then(Value::as_table);
        let is_parameter = match &self.path[..] {
            [name] => {
                !scene.contains_key(name) && parameters.is_some_and(|it| it.contains_key(name))
            }
            _ => false,
        };
        is_parameter.then_some(parameters::TABLE).into_iter().chain(path).collect()
    }

    /// Whether the override changes the field at `path` (such as `emitters[0].period`), a part of
    /// it, or a value that contains it.
    pub(crate) fn concerns(&self, path: &str) -> bool {
        let segments = segments(path);
        let [own, other] = [&self.path[..], &segments].map(without_table);
        let shared = own.len().min(other.len());
        shared > 0 && own[..shared] == other[..shared]
    }
}

/// Removes the name of the table of parameters from the start of a path.
fn without_table(path: &[String]) -> &[String] {
    match path {
        [table, rest @ ..] if table == parameters::TABLE => rest,
        _ => path,
    }
}

/// A table or an array in a scene.
enum Place<'a> {
    Table(&'a mut Table),
    Array(&'a mut Vec<Value>),
}

impl Place<'_> {
    /// Enters the value at `name`. Creates a missing table, unless `next` is an index.
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
