//! Errors that become Python exceptions.

use carom::DerivativeError;
use carom_maze::{EpisodeError, MazeError};
use carom_scene::SceneError;
use carom_scene::part::PartError;
use pyo3::exceptions::PyMemoryError;
use pyo3::prelude::*;
use pyo3::types::PyType;

use crate::stop;

/// Why a call was refused: becomes an exception of `carom.errors` with the message of the engine.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Failure {
    kind: Kind,
    message: String,
    /// Path of the faulty field, for example `colliders[1].restitution`.
    field: Option<String>,
    /// Line in the text of a scene, from 1.
    line: Option<usize>,
}

/// The exception that it becomes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    /// A value is invalid.
    Value,
    /// A scene, or a part of one, is invalid.
    Scene,
    /// A name or number is unknown.
    Unknown,
    /// A step cannot be taken.
    Step,
    /// A signal handler ended a step.
    Stopped,
    /// There is not enough memory.
    Memory,
    /// No picture can be drawn on this machine.
    #[cfg(feature = "pictures")]
    Graphics,
}

impl Kind {
    fn exception(self) -> &'static str {
        match self {
            Self::Value => "CaromError",
            Self::Scene => "SceneError",
            Self::Unknown => "UnknownError",
            Self::Step | Self::Stopped | Self::Memory => "StepError",
            #[cfg(feature = "pictures")]
            Self::Graphics => "GraphicsError",
        }
    }
}

impl Failure {
    fn new(kind: Kind, message: impl ToString) -> Self {
        Self { kind, message: message.to_string(), field: None, line: None }
    }

    /// Returns a failure about an invalid value of the argument `field`.
    pub fn value(field: &str, problem: impl std::fmt::Display) -> Self {
        let failure = Self::new(Kind::Value, format!("{field}: {problem}"));
        Self { field: Some(field.to_owned()), ..failure }
    }

    /// Returns this failure with the argument `field`.
    pub fn about(self, field: &str) -> Self {
        Self {
            message: format!("{field}: {}", self.message),
            field: Some(field.to_owned()),
            ..self
        }
    }

    /// Returns this failure of a world of a batch, by its index.
    pub fn in_world(self, index: usize) -> Self {
        Self { message: format!("world {index}: {}", self.message), ..self }
    }

    /// Returns a failure about a number that is unknown; `kind` is what it should identify.
    pub fn unknown(kind: &str, number: impl std::fmt::Display) -> Self {
        // The text of `carom::Error::Unknown`.
        Self::new(Kind::Unknown, format!("there is no {kind} {number} in this world"))
    }

    /// Returns a failure about missing memory.
    pub fn memory(problem: impl ToString) -> Self {
        Self::new(Kind::Memory, problem)
    }

    /// Returns whether a signal handler raised an exception.
    pub fn is_stop(&self) -> bool {
        self.kind == Kind::Stopped
    }

    /// Returns a failure of graphics with its reason.
    #[cfg(feature = "pictures")]
    pub fn graphics(problem: impl ToString) -> Self {
        Self::new(Kind::Graphics, problem)
    }

    /// Returns a failure about a file of another program that cannot be imported.
    pub fn of_import(error: impl std::error::Error) -> Self {
        Self::new(Kind::Scene, error)
    }

    /// Returns a failure about a file of states that cannot be read or written.
    pub fn of_file(problem: impl ToString) -> Self {
        Self { field: Some("path".to_owned()), ..Self::new(Kind::Value, problem) }
    }

    /// Returns a failure about a scene described in code, which has neither lines nor a name.
    pub fn of_part(error: SceneError) -> Self {
        PartError::from(error).into()
    }
}

impl From<PartError> for Failure {
    fn from(PartError { message, field }: PartError) -> Self {
        let field = Some(field).filter(|field| !field.is_empty());
        Self { field, ..Self::new(Kind::Scene, message) }
    }
}

impl From<carom::Error> for Failure {
    fn from(error: carom::Error) -> Self {
        let (kind, field) = match &error {
            carom::Error::Invalid { source, .. } => (Kind::Value, Some(source.field.to_owned())),
            carom::Error::Unknown(_) => (Kind::Unknown, None),
            carom::Error::Stopped { .. } => (Kind::Stopped, None),
            _ => (Kind::Step, None),
        };
        Self { field, ..Self::new(kind, error) }
    }
}

impl From<DerivativeError> for Failure {
    fn from(error: DerivativeError) -> Self {
        let kind = match error {
            DerivativeError::Step(error) => return error.into(),
            DerivativeError::UnknownSphere(_) | DerivativeError::UnknownCollider(_) => {
                Kind::Unknown
            }
            DerivativeError::Unsupported(_) => Kind::Value,
            _ => Kind::Step,
        };
        Self::new(kind, error)
    }
}

impl From<SceneError> for Failure {
    fn from(error: SceneError) -> Self {
        let message = error.to_string();
        let (kind, field, line) = match error {
            SceneError::Invalid(fault) => (Kind::Scene, Some(fault.field), fault.line),
            SceneError::Overridden { fault, .. } => (Kind::Scene, Some(fault.field), None),
            SceneError::Unknown { .. } => (Kind::Unknown, None, None),
            _ => (Kind::Scene, None, None),
        };
        Self { kind, message, field, line }
    }
}

impl From<EpisodeError> for Failure {
    fn from(error: EpisodeError) -> Self {
        match error {
            EpisodeError::Option { field, requirement, value } => {
                Self::value(field, format_args!("must be {requirement}, not {value}"))
            }
            EpisodeError::Physics(error) => error.into(),
            EpisodeError::Maze(error) => error.into(),
            other => Self::new(Kind::Value, other),
        }
    }
}

impl From<MazeError> for Failure {
    fn from(error: MazeError) -> Self {
        match error {
            MazeError::Scene(error) => error.into(),
            MazeError::Size { .. } => Self::new(Kind::Value, error).about("maze_size"),
            _ => Self::new(Kind::Scene, error).about("maze"),
        }
    }
}

/// A fault of the engine: its descriptions can always be written.
impl From<serde_json::Error> for Failure {
    fn from(error: serde_json::Error) -> Self {
        Self::new(Kind::Value, error)
    }
}

impl From<Failure> for PyErr {
    fn from(failure: Failure) -> Self {
        if failure.kind == Kind::Memory {
            return PyMemoryError::new_err(failure.message);
        }
        let raised = if failure.kind == Kind::Stopped { stop::raised() } else { None };
        raised.unwrap_or_else(|| {
            Python::attach(|py| exception(py, &failure).unwrap_or_else(|error| error))
        })
    }
}

fn exception(py: Python<'_>, failure: &Failure) -> PyResult<PyErr> {
    let class =
        py.import("carom.errors")?.getattr(failure.kind.exception())?.cast_into::<PyType>()?;
    let exception = class.call1((&failure.message, &failure.field, failure.line))?;
    Ok(PyErr::from_value(exception))
}
