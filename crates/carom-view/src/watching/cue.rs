//! The cue of a player who aims.

use carom::{DVec3, SphereId};

/// A cue at the cue ball.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cue {
    pub ball: SphereId,
    /// Velocity that the blow will give the ball \[m/s\]; `None` while the pointer is on the ball.
    pub velocity: Option<DVec3>,
    /// The picture in which it is held.
    pub side: usize,
}
