//! What an answer changed: the spheres whose next events must be predicted.

use crate::detect::contact::Bodies;

/// Spheres whose flights an answer began, in the order in which their next events are predicted.
///
/// Answers predict nothing, so that they read and write only the spheres of their event and those near them.
#[derive(Debug)]
pub(crate) enum Changed {
    /// The two spheres of an impact. Those that `are_searched` have their neighbours, and when they meet them, in the
    /// working memory of the step context.
    Pair { slots: [u32; 2], are_searched: [bool; 2] },
    /// One sphere, and its meetings that need no answer.
    Sphere { slot: u32, unresolved: Vec<Unresolved> },
    /// The spheres of a group, and their meetings that need no answer.
    Group { slots: Vec<u32>, unresolved: Vec<Unresolved> },
    /// Spheres that joined a zone.
    Joined { slots: Vec<u32> },
}

impl Changed {
    /// No sphere.
    pub const NONE: Self = Self::Joined { slots: Vec::new() };

    /// One sphere, all of whose meetings need an answer.
    pub fn sphere(slot: u32) -> Self {
        Self::Sphere { slot, unresolved: Vec::new() }
    }
}

/// Two bodies that touch, and for how long their meetings need no answer.
///
/// Two bodies that hardly touch may meet, by the rounding of one formula, and have nothing to
/// answer, by that of another.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Unresolved {
    pub bodies: Bodies,
    /// Time on the world's clock \[s\].
    pub until: f64,
}
