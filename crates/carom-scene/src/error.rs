//! Errors in scenes: what is wrong, where in the file, and which name was probably meant.

use std::fmt;
use std::path::PathBuf;

use carom::InvalidValue;
use thiserror::Error;

use crate::legible::legible;

/// Longest quotation of a file or a link in an error \[characters\].
const LONGEST_QUOTATION: usize = 120;

/// Longest text of a problem \[characters\]; some texts list many names.
const LONGEST_PROBLEM: usize = 600;

/// Errors of finding, reading and checking scenes.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SceneError {
    /// The scene contains an invalid value.
    #[error(transparent)]
    Invalid(#[from] Fault),
    /// The scene is valid, but not with the values of the overrides.
    #[error("{}: {fault}", legible(.overrides, LONGEST_QUOTATION))]
    Overridden {
        /// The overrides that cause the error.
        overrides: String,
        /// What is wrong when they are applied.
        fault: Box<Fault>,
    },
    /// A file or folder of scenes cannot be read.
    #[error("cannot read {path}: {source}")]
    Unreadable {
        /// Path of the file or folder.
        path: PathBuf,
        /// Error of the operating system.
        source: std::io::Error,
    },
    /// No scene has this name or title.
    #[error(
        "there is no scene \"{}\"{}",
        legible(.name, LONGEST_QUOTATION),
        did_you_mean(.nearest)
    )]
    Unknown {
        /// The name requested.
        name: String,
        /// A name or title that contains the requested name as a word, or else the most similar
        /// one.
        nearest: Option<String>,
    },
    /// An override is not of the form `path=value`.
    #[error("{}: {}", legible(.text, LONGEST_QUOTATION), legible(.problem, LONGEST_PROBLEM))]
    BadOverride {
        /// The override.
        text: String,
        /// What is wrong with the override.
        problem: String,
    },
}

/// One error in a scene.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub struct Fault {
    /// File or other source of the scene.
    pub source_name: String,
    /// Line in the file, from 1; `None` where the value does not come from a file.
    pub line: Option<usize>,
    /// Path of the field, like `colliders[1].restitution`; empty for the file as a whole.
    pub field: String,
    /// What is wrong.
    pub problem: String,
    /// Most similar known name, if the name is unknown.
    pub nearest: Option<String>,
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&legible(&self.source_name, LONGEST_PROBLEM))?;
        if let Some(line) = self.line {
            write!(f, ":{line}")?;
        }
        if !self.field.is_empty() {
            write!(f, ": {}", legible(&self.field, LONGEST_QUOTATION))?;
        }
        let problem = legible(&self.problem, LONGEST_PROBLEM);
        write!(f, ": {problem}{}", did_you_mean(&self.nearest))
    }
}

pub(crate) fn did_you_mean(nearest: &Option<String>) -> String {
    nearest.as_ref().map_or(String::new(), |name| format!("; did you mean \"{name}\"?"))
}

/// An error at a path of the scene, before its line in the file is known.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Problem {
    pub field: String,
    pub problem: String,
}

impl Problem {
    pub fn new(field: impl Into<String>, problem: impl Into<String>) -> Self {
        Self { field: field.into(), problem: problem.into() }
    }

    /// Puts `name`, a name or an index, before the path of the problem.
    pub fn below(self, name: &str) -> Self {
        Self { field: format!("{name}{}", self.field), ..self }
    }

    /// Converts an error of `carom` about the value at `path`.
    pub fn of_physics(path: &str, error: carom::Error) -> Self {
        match error {
            carom::Error::Invalid {
                source: InvalidValue { field, requirement, value }, ..
            } => {
                Self::new(format!("{path}.{field}"), format!("must be {requirement}, not {value}"))
            }
            other => Self::new(path, other.to_string()),
        }
    }

    /// Converts the problem to a fault of a scene that was built in code.
    pub fn in_code(self, scene: &str) -> Fault {
        let Self { field, problem } = self;
        Fault { source_name: scene.to_owned(), line: None, field, problem, nearest: None }
    }
}

/// Splits a path into names and indices: `colliders[1].shape` has three.
pub(crate) fn segments(path: &str) -> Vec<String> {
    path.split(['.', '[', ']']).filter(|part| !part.is_empty()).map(str::to_owned).collect()
}

/// Whether two names differ by one or two typing errors only.
pub(crate) fn is_much_like(name: &str, other: &str) -> bool {
    strsim::jaro_winkler(&name.to_lowercase(), other) > 0.9
}

/// Returns the candidate most similar to `name`; `None` if none is similar.
pub(crate) fn nearest<'a>(
    name: &str,
    candidates: impl IntoIterator<Item = &'a str>,
) -> Option<String> {
    // Below this, suggestions are guesses.
    const SIMILAR: f64 = 0.8;
    // A name that starts with another letter and differs more than this is not suggested: a
    // triangle is no rectangle.
    const SLIPS: usize = 2;
    let name = name.to_lowercase();
    let mut best = (SIMILAR, None);
    for candidate in candidates {
        let lower = candidate.to_lowercase();
        let similarity = strsim::jaro_winkler(&name, &lower);
        let begins_so = name.chars().next() == lower.chars().next();
        let is_meant = begins_so || strsim::osa_distance(&name, &lower) <= SLIPS;
        if is_meant && similarity > best.0 {
            best = (similarity, Some(candidate.to_owned()));
        }
    }
    best.1
}
