//! Whether the surfaces in a contact roll on each other or slide.

use glam::DVec3;

/// What friction does in a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum FrictionState {
    /// It does not act.
    None,
    /// The surfaces do not slide on each other.
    Rolls,
    /// Body 2 slides on body 1.
    Slides {
        /// Unit vector of the slip at the start, or of the slip that begins.
        direction: DVec3,
        /// Slip below which the direction is this one \[m/s\].
        least: f64,
        /// Slip in the opposite direction at which the state ends \[m/s\].
        most_back: f64,
        /// Slip along the direction at which the state ends \[m/s\].
        most: f64,
    },
}
