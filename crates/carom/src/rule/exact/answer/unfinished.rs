//! Reasons why a step under the rule `exact` ends early.

use crate::id::SphereId;

/// Reason why a part of a frame was not completed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Unfinished {
    /// A sphere took more work than the parameters allow.
    TooManyImpacts {
        /// A sphere that was at work then.
        sphere: SphereId,
        /// The bound per sphere.
        limit: u32,
        /// How many spheres it was in persistent contact with, directly or through others.
        companions: usize,
        /// When it happened, on the world's clock \[s\].
        time: f64,
    },
    /// Friction acts in a way that has no closed form, and nothing is stepped.
    NoClosedForm {
        /// A sphere that it acts on.
        sphere: SphereId,
        /// When it happened, on the world's clock \[s\].
        time: f64,
    },
    /// Growth made a sphere so fast that it has no room left.
    NoRoomToGrow {
        /// The sphere.
        sphere: SphereId,
        /// When it happened, on the world's clock \[s\].
        time: f64,
    },
    /// A sphere with a potential between spheres rests on something.
    RestsInPotential {
        /// The sphere.
        sphere: SphereId,
        /// When it happened, on the world's clock \[s\].
        time: f64,
    },
    /// A force on a sphere is not finite.
    NonFiniteForce {
        /// The sphere.
        sphere: SphereId,
    },
    /// A stop request came.
    Stopped,
}
