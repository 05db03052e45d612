//! Errors of sessions.

use carom_scene::SceneError;
use thiserror::Error;

/// Names of a scene that a message lists at most.
const MOST_NAMES: usize = 8;

impl SessionError {
    /// Whether the error means that a request ended the step early.
    pub fn is_stop(&self) -> bool {
        matches!(self, Self::World(carom::Error::Stopped { .. }))
    }
}

/// Why a session refused an operation. The session is unchanged unless stated otherwise.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SessionError {
    /// The physics refused it.
    #[error(transparent)]
    World(#[from] carom::Error),
    /// The edited scene would not be valid as a file.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A change of a run that is repeated was refused.
    #[error("the edit at frame {frame} cannot be repeated: {source}")]
    Repeat {
        /// Frame at which the session is now; the following changes are dropped.
        frame: u64,
        /// Error of the change.
        source: Box<SessionError>,
    },
    /// An edit of colliders by a [group name](crate::group_name) that none has.
    #[error("no collider has the name {name:?}{}", others(.known))]
    NoCollider {
        /// The group name of the edit.
        name: String,
        /// Group names of the scene, each once.
        known: Vec<String>,
    },
    /// An edit of the scale of a collider that has none, or a scale that is no positive number.
    #[error("only a mesh, a height field and a track have a scale, a positive number")]
    NoScale,
    /// A shape that cannot be made.
    #[error("{0}")]
    Shape(String),
    /// The time is negative or not finite.
    #[error("cannot go to {seconds} s: the time must be zero or positive, and finite")]
    Time {
        /// The time requested \[s\].
        seconds: f64,
    },
    /// The frame at this time is too far from the start.
    #[error("cannot go to {seconds} s: that is more than 100,000,000 frames after the start")]
    TooFar {
        /// The time requested \[s\].
        seconds: f64,
    },
    /// Too many commands wait; they would take many seconds.
    #[error("too many commands are waiting; the last one was not accepted")]
    Busy,
    /// The thread of the driver cannot be started.
    #[error("cannot start the thread of the simulation: {0}")]
    Thread(#[from] std::io::Error),
    /// The thread of the driver has ended.
    #[error("the thread of the simulation has ended, so nothing moves any more")]
    Ended,
}

/// The names that colliders have, for a message of one line.
fn others(known: &[String]) -> String {
    let named: Vec<String> =
        known.iter().filter(|name| !name.is_empty()).map(|name| format!("{name:?}")).collect();
    match &named[..] {
        [] => "; none has a name".to_owned(),
        all if all.len() > MOST_NAMES => {
            format!("; there are {}, and others", all[..MOST_NAMES].join(", "))
        }
        all => format!("; there are {}", all.join(", ")),
    }
}
