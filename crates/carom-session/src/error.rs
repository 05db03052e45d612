//! What can go wrong with a scene being watched.

use carom_scene::SceneError;
use thiserror::Error;

impl SessionError {
    /// Whether a request ended the step, which is no fault.
    pub fn is_stop(&self) -> bool {
        matches!(self, Self::World(carom::Error::Stopped { .. }))
    }
}

/// Why something could not be done. The session is as it was before, unless said otherwise.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SessionError {
    /// The physics refuses it.
    #[error(transparent)]
    World(#[from] carom::Error),
    /// It would make a scene that no file could hold.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A change of a run that is repeated cannot be made.
    #[error("at frame {frame}, what was changed there cannot be changed again: {source}")]
    Repeat {
        /// Where it is now; the changes that were to follow are dropped.
        frame: u64,
        /// What is wrong with the change.
        source: Box<SessionError>,
    },
    /// No frame is at this time.
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
    /// More waits to be done than could be done in seconds.
    #[error("too much waits to be done already; the last command was not taken")]
    Busy,
    /// No thread can be had to move the spheres.
    #[error("cannot start a thread that moves the spheres: {0}")]
    Thread(#[from] std::io::Error),
    /// The thread that moves the spheres is gone.
    #[error("nothing moves any more: the thread that moves the spheres has ended")]
    Ended,
}
