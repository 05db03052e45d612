//! Numbers that a scene suggests to change.

use crate::error::{Problem, SceneError, segments};
use crate::requirement::check;
use crate::scene::{Scene, Try};

/// Largest number of suggestions of a scene.
const MOST: usize = 3;

/// Longest text of a suggestion \[characters\].
const LONGEST: usize = 80;

/// A number of a scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tried {
    /// Value of the field now.
    pub value: f64,
    /// Whether it is a whole number.
    pub is_whole: bool,
}

impl Try {
    /// Returns the number of the suggestion in `scene`; `None` if there is none at the path.
    pub fn number_in(&self, scene: &Scene) -> Option<Tried> {
        let whole = toml::Value::try_from(scene).ok()?;
        let at = |value: &toml::Value, name: &String| match value {
            toml::Value::Table(table) => table.get(name).cloned(),
            toml::Value::Array(array) => array.get(name.parse::<usize>().ok()?).cloned(),
            _ => None,
        };
        let found = segments(&self.path).iter().try_fold(whole, |value, name| at(&value, name))?;
        match found {
            toml::Value::Integer(value) => Some(Tried { value: value as f64, is_whole: true }),
            toml::Value::Float(value) => Some(Tried { value, is_whole: false }),
            _ => None,
        }
    }

    /// Returns `scene` with another value of the number.
    ///
    /// # Errors
    /// [`SceneError`] if the scene has no such number, or is invalid with that value.
    pub fn applied_to(&self, scene: &Scene, value: f64) -> Result<Scene, SceneError> {
        let is_whole = self.number_in(scene).is_some_and(|it| it.is_whole);
        let value = if is_whole { format!("{}", value.round()) } else { format!("{value:?}") };
        scene.with(&[format!("{}={value}", self.path).parse()?])
    }
}

/// Checks the suggestions of a scene.
pub(crate) fn check_tries(tries: &[Try]) -> Result<(), Problem> {
    check(tries.len() <= MOST, "try", || format!("must be at most {MOST}, not {}", tries.len()))?;
    for (i, Try { text, path, range: [low, high] }) in tries.iter().enumerate() {
        let field = |name: &str| format!("try[{i}].{name}");
        let is_short = !text.trim().is_empty() && text.chars().nth(LONGEST).is_none();
        check(is_short && !text.chars().any(char::is_control), &field("text"), || {
            format!("must be a line of 1 to {LONGEST} characters")
        })?;
        let has_parts = segments(path).len() > 1 && !path.contains(['=', '\n']);
        check(has_parts, &field("path"), || {
            format!("must be a path like `colliders.0.restitution`, not \"{path}\"")
        })?;
        let is_range = low < high && low.is_finite() && high.is_finite();
        check(is_range, &field("range"), || {
            format!("must be two finite numbers, the smaller first, not [{low}, {high}]")
        })?;
    }
    Ok(())
}
