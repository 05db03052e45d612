//! Changes from outside that were made on the way.

use crate::edit::Edit;

/// Something that changed the world from outside of a step.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Change {
    /// An edit.
    Edit(Edit),
    /// A step failed, after which flights begin anew.
    FailedStep,
}

impl Change {
    /// Length of the frames that follow \[s\], if this sets it.
    pub(crate) fn frame_time(&self) -> Option<f64> {
        match self {
            Self::Edit(Edit::FrameTime(frame_time)) => Some(*frame_time),
            Self::Edit(Edit::Simulation(simulation)) => Some(simulation.frame_time),
            Self::Edit(_) | Self::FailedStep => None,
        }
    }
}

/// A change, and when it was made.
#[derive(Debug, Clone, PartialEq)]
pub struct PastChange {
    /// Number of frames that were taken before.
    pub frame: u64,
    /// What was changed.
    pub change: Change,
}
