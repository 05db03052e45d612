//! Events of two spheres in the step report, at the edge of their well.

use std::fmt::{self, Display};

use glam::DVec3;

use crate::id::SphereId;

/// Two spheres at the edge of their well.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct WellEvent {
    /// Time since the start of the step \[s\].
    pub time: f64,
    /// The spheres, in order of id.
    pub between: [SphereId; 2],
    /// What happened.
    pub kind: WellEventKind,
    /// Unit vector from the first centre to the second.
    pub normal: DVec3,
    /// Distance of the centres \[m\].
    pub distance: f64,
    /// Impulse that drives the spheres apart \[N s\]; < 0 where it draws them together.
    pub impulse: f64,
}

/// What happens to two spheres at the edge of their well.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum WellEventKind {
    /// They enter the well.
    Capture,
    /// They leave the well.
    Dissociation,
    /// They turn back: from inside, too slow to leave, or from outside at a shoulder.
    Bounce,
}

impl Display for WellEventKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Capture => "capture",
            Self::Dissociation => "dissociation",
            Self::Bounce => "bounce",
        })
    }
}
