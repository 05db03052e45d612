//! Changes of a world that are made from outside, between frames.

use crate::edit::Edit;

/// A change of the world from outside of a step.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Change {
    /// An edit.
    Edit(Edit),
    /// A step failed; all flights are then computed again.
    FailedStep,
}

impl Change {
    /// Length of the following frames \[s\], if the change sets it.
    pub(crate) fn frame_time(&self) -> Option<f64> {
        match self {
            Self::Edit(Edit::FrameTime(frame_time)) => Some(*frame_time),
            Self::Edit(Edit::Simulation(simulation)) => Some(simulation.frame_time),
            Self::Edit(_) | Self::FailedStep => None,
        }
    }
}

/// A change, with the frame at which it was made.
#[derive(Debug, Clone, PartialEq)]
pub struct PastChange {
    /// Number of frames taken before the change.
    pub frame: u64,
    /// The change.
    pub change: Change,
}
