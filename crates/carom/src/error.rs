//! Errors, in words by which a user can fix them.

use std::fmt::{self, Display};

use thiserror::Error;

use crate::id::{ColliderId, EmitterId, ForceId, SphereId, SpringId};

/// Error of the engine. The world is unchanged after each.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Error {
    /// A number is invalid.
    #[error("{subject}: {source}")]
    Invalid {
        /// The object with the number.
        subject: Subject,
        /// The number, and its requirement.
        source: InvalidValue,
    },
    /// The id names nothing in this world (any more).
    #[error("there is no {0} in this world")]
    Unknown(Subject),
    /// Forces or speeds grew past what a number can hold.
    #[error(
        "sphere {sphere}: {quantity} is no longer finite in the step that starts at {time} s; the state before the \
         step was kept. Where drag or springs are stiff, shorter frames or the rule `exact` may help"
    )]
    NonFiniteState {
        /// The first sphere it happened to.
        sphere: SphereId,
        /// `"position"` or `"velocity"`.
        quantity: &'static str,
        /// Start of the refused step \[s\].
        time: f64,
    },
    /// A step took more work than [`Exact::max_impacts`](crate::Exact::max_impacts) allows.
    #[error(
        "sphere {sphere}{}, at {at} s: more impacts and other work than the {limit} per sphere and \
         frame that `max_impacts` allows; the state before the step, at {time} s, was kept. Shorter \
         frames, a longer `contact_duration`, a smaller `restitution` or a larger `max_impacts` may \
         help; the rule `contact` is made for heaps", in_contact_with(*companions)
    )]
    TooManyImpacts {
        /// A sphere that was at work then.
        sphere: SphereId,
        /// The bound.
        limit: u32,
        /// How many spheres it was in persistent contact with, directly or through others.
        companions: usize,
        /// When the bound was reached \[s\].
        at: f64,
        /// Start of the refused step \[s\].
        time: f64,
    },
    /// Friction acts on a sphere in a way that the rule `exact` can follow in stepped zones only, and its settings
    /// allow none.
    #[error(
        "sphere {sphere}, at {at} s: friction acts on it in contacts that have no closed form, and \
         the setting `zones` forbids to step it; the state before the step, at {time} s, was kept. \
         Use `zones = \"automatic\"`, or the rule `contact`, which steps everything"
    )]
    NeedsZone {
        /// A sphere that it acts on.
        sphere: SphereId,
        /// When it was needed \[s\].
        at: f64,
        /// Start of the refused step \[s\].
        time: f64,
    },
    /// Growth made a sphere 256 times as fast as any was when the growth began, or took more impacts of it in a step
    /// than [`Exact::max_impacts`](crate::Exact::max_impacts).
    #[error(
        "sphere {sphere}, at {at} s: it has no room left to grow: neighbours or walls made it 256 times as fast as \
         any was when growth began; the state before the step, at {time} s, was kept. End earlier, or take fewer \
         or smaller spheres; `carom pack` makes dense packings"
    )]
    NoRoomToGrow {
        /// The sphere.
        sphere: SphereId,
        /// When it happened \[s\].
        at: f64,
        /// Start of the refused step \[s\].
        time: f64,
    },
    /// A sphere with a pair potential rests on another body, which the rule `exact` does not follow.
    #[error(
        "sphere {sphere}, at {at} s: it came to rest on another body, which a `pair_potential` does not allow; the \
         state before the step, at {time} s, was kept"
    )]
    RestsInPotential {
        /// The sphere.
        sphere: SphereId,
        /// When it happened \[s\].
        at: f64,
        /// Start of the refused step \[s\].
        time: f64,
    },
    /// A [`StopRequest`](crate::StopRequest) ended the step.
    #[error("the step that starts at {time} s was stopped; the state before it was kept")]
    Stopped {
        /// Start of the step \[s\].
        time: f64,
    },
}

/// The number of contacts, for a message.
fn in_contact_with(companions: usize) -> String {
    match companions {
        0 => String::new(),
        1 => ", in contact with another".to_owned(),
        more => format!(", in contact with {more} others"),
    }
}

/// What an error is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Subject {
    /// A sphere; for one that was refused, the id it would have had.
    Sphere(SphereId),
    /// A collider; for one that was refused, the id it would have had.
    Collider(ColliderId),
    /// An emitter; for one that was refused, the id it would have had.
    Emitter(EmitterId),
    /// A force; for one that was refused, the id it would have had.
    Force(ForceId),
    /// A spring; for one that was refused, the id it would have had.
    Spring(SpringId),
    /// The settings of the world.
    Settings,
    /// The call of `World::step`.
    Step,
    /// A query of the world.
    Query,
}

impl Display for Subject {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Sphere(id) => write!(f, "sphere {id}"),
            Self::Collider(id) => write!(f, "collider {id}"),
            Self::Emitter(id) => write!(f, "emitter {id}"),
            Self::Force(id) => write!(f, "force {id}"),
            Self::Spring(id) => write!(f, "spring {id}"),
            Self::Settings => f.write_str("settings"),
            Self::Step => f.write_str("step"),
            Self::Query => f.write_str("query"),
        }
    }
}

/// A field with an invalid value, and what it must be.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("`{field}` must be {requirement}, not {value}")]
pub struct InvalidValue {
    /// Name of the field as users write it.
    pub field: &'static str,
    /// What it must be, continuing "must be".
    pub requirement: &'static str,
    /// The value that was given.
    pub value: String,
}

impl InvalidValue {
    pub(crate) fn about(self, subject: Subject) -> Error {
        Error::Invalid { subject, source: self }
    }
}
