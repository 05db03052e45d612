//! Errors of drawn mazes, and their largest size.

use thiserror::Error;

/// Largest number of characters along a side; larger mazes are slow and no fun.
pub(crate) const LONGEST_SIDE: usize = 81;

/// Why a drawing is invalid.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum TextProblem {
    /// A character is unknown.
    #[error(
        "unknown character {0:?}; a maze is drawn with '#' wall, ' ' or '.' floor, 'o' \
         collectible, 'S' start, 'E' end wall"
    )]
    UnknownCharacter(char),
    /// `walls:` is neither `thin` nor `thick`.
    #[error("`walls:` must be `thin` or `thick`")]
    UnknownWalls,
    /// Nothing is drawn.
    #[error("nothing is drawn")]
    Empty,
    /// The drawing is too large.
    #[error("too large: at most {LONGEST_SIDE} lines and columns")]
    TooLarge,
    /// There is no `S`.
    #[error("no start: mark it with 'S'")]
    NoStart,
    /// There is a second `S`.
    #[error("a second start; the first is at {line}:{column}")]
    SecondStart {
        /// Line of the first, from 1.
        line: usize,
        /// Column of the first, from 1.
        column: usize,
    },
    /// There is no `E`.
    #[error("no end wall: mark it with 'E'")]
    NoEnd,
    /// The ball does not fit at its start.
    #[error("the start is too narrow for the ball")]
    NarrowStart,
    /// The ball cannot reach an end wall from the start.
    #[error("no way from this start to an end wall that is wide enough for the ball")]
    NoWay,
    /// The ball cannot reach a collectible from the start.
    #[error("no way from the start to this collectible that is wide enough for the ball")]
    NoWayTo,
}
