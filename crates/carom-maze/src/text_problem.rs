//! What can be wrong with a drawn maze, and how large one may be.

use thiserror::Error;

/// Characters along a side, at most: more walls than that are no game, and slow.
pub(crate) const LONGEST_SIDE: usize = 81;

/// What is wrong with a drawing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum TextProblem {
    /// A character that means nothing.
    #[error(
        "unknown character {0:?}; a maze is drawn with '#' wall, ' ' or '.' floor, 'o' \
         collectible, 'S' start, 'E' end wall"
    )]
    UnknownCharacter(char),
    /// `walls:` with something else than `thin` or `thick`.
    #[error("`walls:` must be `thin` or `thick`")]
    UnknownWalls,
    /// Nothing is drawn.
    #[error("nothing is drawn")]
    Empty,
    /// More characters than a maze may have.
    #[error("too large: at most {LONGEST_SIDE} lines and columns")]
    TooLarge,
    /// No `S`.
    #[error("no start: mark it with 'S'")]
    NoStart,
    /// Another `S`.
    #[error("a second start; the first is at {line}:{column}")]
    SecondStart {
        /// Line of the first, from 1.
        line: usize,
        /// Column of the first, from 1.
        column: usize,
    },
    /// No `E`.
    #[error("no end wall: mark it with 'E'")]
    NoEnd,
    /// The ball cannot stand where it starts.
    #[error("the start is too narrow for the ball")]
    NarrowStart,
    /// The ball cannot get from the start to an end wall.
    #[error("no way from this start to an end wall that is wide enough for the ball")]
    NoWay,
    /// The ball cannot get from the start to a collectible.
    #[error("no way from the start to this collectible that is wide enough for the ball")]
    NoWayTo,
}
