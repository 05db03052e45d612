//! Errors of links.

use carom_scene::scene::Rule;
use carom_scene::{Fault, SceneError, legible};
use thiserror::Error;

use super::packed::PackedError;

/// Longest text of moves in a link \[bytes\]: a quarter of an hour of keys, or hundreds of strikes.
pub const MAX_MOVES: usize = 1 << 16;

/// Names of the parts of a link.
const PARTS: [&str; 12] = [
    "scene",
    "file",
    "name",
    "set",
    "rule",
    "edits",
    "beside",
    "beside-edits",
    "t",
    "camera",
    "goal",
    "moves",
];

/// Quotes the beginning of a text in one line.
pub fn quoted(text: &str) -> String {
    /// Most characters.
    const LONGEST: usize = 40;
    legible(text, LONGEST)
}

/// What is wrong with a link.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum LinkError {
    /// The link is empty.
    #[error("the link is empty: after # it needs scene=NAME or file=...")]
    Empty,
    /// A part has an unknown name.
    #[error("the link has a part \"{part}\"; links know only {}", PARTS.join(", "))]
    Unknown {
        /// The part as written, shortened.
        part: String,
    },
    /// A part occurs twice.
    #[error("the link says {part} twice")]
    Repeated {
        /// Name of the part.
        part: &'static str,
    },
    /// The link names no scene.
    #[error("the link names no scene: it needs scene=NAME or file=...")]
    NoScene,
    /// The link names two scenes.
    #[error("the link says both scene and file; it can lead to one of them only")]
    TwoScenes,
    /// The link names a file but contains none.
    #[error("the link says name, which is for a file, but no file")]
    NameOfNoFile,
    /// A part is not valid text.
    #[error("{part} of the link is garbled: it is no text")]
    NoText {
        /// Name of the part.
        part: &'static str,
    },
    /// The link has edits of a second run, but no second run.
    #[error("the link says beside-edits, which is for a second run, but no beside")]
    EditsOfNoRun,
    /// The rule is unknown.
    #[error("the link says {part}={found}; the rules are {}", Rule::NAMES.join(", "))]
    Rule {
        /// Name of the part.
        part: &'static str,
        /// The rule as written, shortened.
        found: String,
    },
    /// The time is invalid.
    #[error("the link says t={found}; the time must be a number of seconds, zero or positive")]
    Time {
        /// The time as written, shortened.
        found: String,
    },
    /// The camera is invalid.
    #[error(
        "the link says camera={found}; it must be x,y,z to look from and x,y,z to look at, in m, and may have a field of view in degrees"
    )]
    Camera {
        /// The camera as written, shortened.
        found: String,
    },
    /// The result to beat is invalid.
    #[error("the link says goal={found}; the result to beat must be a number, zero or positive")]
    Goal {
        /// The result as written, shortened.
        found: String,
    },
    /// The moves are too long.
    #[error("the moves of the link are longer than {} KiB, the limit", MAX_MOVES >> 10)]
    Moves,
    /// A packed part cannot be unpacked.
    #[error("{part} of the link {source}")]
    Packed {
        /// Name of the part.
        part: &'static str,
        /// Error of unpacking.
        source: PackedError,
    },
    /// The edits cannot be read.
    #[error("the edits of the link are invalid: {problem}")]
    Edits {
        /// What is wrong with the edits.
        problem: String,
    },
    /// The scene or an override is invalid. Quotations of the link are shortened.
    #[error(transparent)]
    Scene(SceneError),
}

impl From<SceneError> for LinkError {
    fn from(error: SceneError) -> Self {
        Self::Scene(brief(error))
    }
}

/// Shortens the quotations in an error of a scene, which the author of the link wrote.
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

/// Shortens a problem to a few lines of a window.
pub fn brief_problem(problem: &str) -> String {
    /// Most characters.
    const LONGEST: usize = 160;
    legible(problem, LONGEST)
}
