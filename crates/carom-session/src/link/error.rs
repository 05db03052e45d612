//! What can be wrong with a link.

use carom_scene::scene::Rule;
use carom_scene::{Fault, SceneError, legible};
use thiserror::Error;

use super::packed::PackedError;

/// Names of the parts of a link.
const PARTS: [&str; 8] = ["scene", "file", "name", "set", "rule", "edits", "t", "camera"];

/// The beginning of what a link says, in one line.
pub fn quoted(text: &str) -> String {
    /// In characters.
    const LONGEST: usize = 40;
    legible(text, LONGEST)
}

/// What is wrong with a link.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum LinkError {
    /// It says nothing.
    #[error("the link says nothing: after # it needs scene=NAME or file=...")]
    Empty,
    /// A part of it has no known name.
    #[error("the link has a part \"{part}\"; links know only {}", PARTS.join(", "))]
    Unknown {
        /// As it is written, shortened.
        part: String,
    },
    /// It says something twice that it can say once.
    #[error("the link says {part} twice")]
    Repeated {
        /// Name of the part.
        part: &'static str,
    },
    /// It names no scene.
    #[error("the link names no scene: it needs scene=NAME or file=...")]
    NoScene,
    /// It names two scenes.
    #[error("the link says both scene and file; it can lead to one of them only")]
    TwoScenes,
    /// A part that belongs to a file, without one.
    #[error("the link says name, which is for a file, but no file")]
    NameOfNoFile,
    /// A part is no text.
    #[error("{part} of the link is garbled: it is no text")]
    NoText {
        /// Name of the part.
        part: &'static str,
    },
    /// It names no rule.
    #[error("the link says rule={found}; the rules are {}", Rule::NAMES.join(", "))]
    Rule {
        /// As it is written, shortened.
        found: String,
    },
    /// Its time is none.
    #[error("the link says t={found}; the time must be a number of seconds, zero or positive")]
    Time {
        /// As it is written, shortened.
        found: String,
    },
    /// It looks from nowhere.
    #[error(
        "the link says camera={found}; it must be x,y,z to look from and x,y,z to look at, in m, and may have a field of view in degrees"
    )]
    Camera {
        /// As it is written, shortened.
        found: String,
    },
    /// A packed part cannot be unpacked.
    #[error("{part} of the link {source}")]
    Packed {
        /// Name of the part.
        part: &'static str,
        /// Why.
        source: PackedError,
    },
    /// The changes on the way cannot be read.
    #[error("edits of the link make no sense: {problem}")]
    Edits {
        /// What is wrong with them.
        problem: String,
    },
    /// Something is wrong with its scene, or an override of it. What it quotes of the link is shortened.
    #[error(transparent)]
    Scene(SceneError),
}

impl From<SceneError> for LinkError {
    fn from(error: SceneError) -> Self {
        Self::Scene(brief(error))
    }
}

/// The error of a scene with short quotations: all that it quotes was written by the author of the link.
fn brief(error: SceneError) -> SceneError {
    match error {
        SceneError::Invalid(fault) => SceneError::Invalid(brief_fault(fault)),
        SceneError::Overridden { overrides, fault } => SceneError::Overridden {
            overrides: quoted(&overrides),
            fault: Box::new(brief_fault(*fault)),
        },
        SceneError::Unknown { name, nearest } => {
            SceneError::Unknown { name: quoted(&name), nearest }
        }
        SceneError::BadOverride { text, problem } => {
            SceneError::BadOverride { text: quoted(&text), problem: brief_problem(&problem) }
        }
        other => other,
    }
}

fn brief_fault(fault: Fault) -> Fault {
    Fault {
        source_name: quoted(&fault.source_name),
        line: fault.line,
        field: quoted(&fault.field),
        problem: brief_problem(&fault.problem),
        nearest: fault.nearest.map(|it| quoted(&it)),
    }
}

/// What is wrong, in at most some lines of a window.
pub fn brief_problem(problem: &str) -> String {
    /// In characters.
    const LONGEST: usize = 160;
    legible(problem, LONGEST)
}
