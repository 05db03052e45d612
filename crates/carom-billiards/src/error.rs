//! Errors of tables, moves and games, with messages that say how to fix them.

use carom_scene::SceneError;
use thiserror::Error;

/// Why a scene is no table for nine-ball.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum TableError {
    /// The spheres are not the ten balls.
    #[error(
        "scene \"{scene}\": nine-ball needs ten single spheres, whose `user_data` is 0 for the cue ball and 1 to 9 for the \
         others"
    )]
    Balls {
        /// Name of the scene.
        scene: String,
    },
    /// A collider that the game needs is missing.
    #[error("scene \"{scene}\": nine-ball needs {what}")]
    Missing {
        /// Name of the scene.
        scene: String,
        /// The missing collider.
        what: &'static str,
    },
    /// The scene is invalid.
    #[error(transparent)]
    Scene(#[from] SceneError),
}

/// Why a move is refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum MoveError {
    /// A game has another number of players than one or two.
    #[error("nine-ball is for one or two players, and one of them breaks")]
    Players,
    /// A push-out is declared at another time.
    #[error("only the shot after a break without a foul may be a push-out")]
    PushOut,
    /// An answer without a push-out.
    #[error("there is no push-out to answer")]
    Answer,
    /// A strike while balls roll, or after the end.
    #[error("no shot is due")]
    Shot,
    /// The cue ball is not in hand.
    #[error("the cue ball is not in hand")]
    NotInHand,
    /// The cue ball cannot be where it is put.
    #[error(
        "the cue ball has to be on the table, free of other balls, and for the break behind the head string"
    )]
    Place,
    /// A strike that no cue gives.
    #[error(
        "a strike needs a speed up to that which crosses the table in 0.2 s, an elevation from 0 to 90 degrees, and an offset \
         of at most half the radius"
    )]
    Strike,
    /// A text that is no move.
    #[error(
        "a move is `place X Z`, `strike SPEED AZIMUTH ELEVATION RIGHT UP`, `push-out`, `shoot` or `leave`"
    )]
    Text,
}

/// Why a game cannot begin or go on.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum GameError {
    /// The rules refuse a move.
    #[error(transparent)]
    Move(#[from] MoveError),
    /// The physics refused a change or a frame.
    #[error(transparent)]
    Physics(#[from] carom::Error),
    /// The scene of the table is invalid.
    #[error(transparent)]
    Scene(#[from] SceneError),
}
