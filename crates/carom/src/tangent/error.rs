//! Errors of derivatives.

use thiserror::Error as ThisError;

use crate::error::Error;
use crate::id::{ColliderId, SphereId, SpringId};

/// Why derivatives cannot be followed.
#[derive(Debug, Clone, PartialEq, ThisError)]
#[non_exhaustive]
pub enum DerivativeError {
    /// The step itself was refused.
    #[error(transparent)]
    Step(#[from] Error),
    /// The world has something whose derivatives are not known.
    #[error("derivatives are not known of {0}")]
    Unsupported(&'static str),
    /// A direction changes a sphere that is not in the world.
    #[error("there is no sphere {0} in this world")]
    UnknownSphere(SphereId),
    /// A direction changes a collider that is not in the world.
    #[error("there is no collider {0} in this world")]
    UnknownCollider(ColliderId),
    /// A direction changes a spring that is not in the world.
    #[error("there is no spring {0} in this world")]
    UnknownSpring(SpringId),
    /// Several impacts at one instant among bodies that touch: the motion after them depends on which one a small
    /// change makes first.
    #[error(
        "sphere {sphere} has several impacts at {time} s at once: no derivative, since a small change decides \
         which comes first"
    )]
    Simultaneous {
        /// One of the spheres.
        sphere: SphereId,
        /// Time on the world's clock \[s\].
        time: f64,
    },
    /// A sphere neither flew freely nor stayed on one plane, or between smooth ones, between its impacts: it presses on
    /// another sphere, lies on a curve or an edge, between rough planes, or on a surface that turns or speeds up, or it is in a
    /// stepped zone.
    #[error(
        "sphere {sphere} did not fly freely, or stay on one plane, between {from} s and {to} s: derivatives \
         are known of such motion and of impacts only"
    )]
    PersistentContact {
        /// The sphere.
        sphere: SphereId,
        /// Start of the step \[s\].
        from: f64,
        /// End of the step \[s\].
        to: f64,
    },
    /// Spheres were added or removed since the last step.
    #[error("spheres were added or removed since the last step: begin the derivatives again")]
    Changed,
}
