use super::{Bisect, Discrete, Exact};

/// How a frame is taken.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Rule {
    /// The course's rule: move every sphere by the frame, then answer what overlaps at its end.
    ///
    /// Fast, but contacts are found late, and a sphere that crosses a surface within a frame
    /// passes through it.
    Discrete(Discrete),
    /// The tutorial's rule: where spheres intersect at the end of the frame, wind them back, find
    /// the time of contact by bisection, answer it there and go on with the rest of the frame.
    ///
    /// A contact that begins and ends within a frame is still missed.
    Bisect(Bisect),
    /// Carom's own rule: spheres fly in closed form from one event to the next, and every impact
    /// happens at its own time, however many there are in a frame and however fast they are. A
    /// frame only says when to look.
    Exact(Exact),
}

impl Default for Rule {
    fn default() -> Self {
        Self::Exact(Exact::default())
    }
}

impl From<Discrete> for Rule {
    fn from(parameters: Discrete) -> Self {
        Self::Discrete(parameters)
    }
}

impl From<Bisect> for Rule {
    fn from(parameters: Bisect) -> Self {
        Self::Bisect(parameters)
    }
}

impl From<Exact> for Rule {
    fn from(parameters: Exact) -> Self {
        Self::Exact(parameters)
    }
}
