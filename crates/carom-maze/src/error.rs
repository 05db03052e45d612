//! What can go wrong, said so that a user can mend it.

use std::fmt;

use carom_scene::SceneError;
use thiserror::Error;

use crate::text_problem::TextProblem;

/// Why something is no maze.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum MazeError {
    /// A drawing makes no sense.
    #[error("{name}{}: {problem}", at(.place))]
    Text {
        /// What the drawing is called.
        name: String,
        /// Line and column in the text, each from 1; `None` for the drawing as a whole.
        place: Option<(usize, usize)>,
        /// What is wrong.
        problem: TextProblem,
    },
    /// A maze has one ball.
    #[error("scene \"{scene}\": a maze has one sphere, the ball, not {count}")]
    OneBall {
        /// Name of the scene.
        scene: String,
        /// Spheres in it; generators and emitters count too.
        count: usize,
    },
    /// The maze has no wall to win at.
    #[error("scene \"{scene}\": no solid collider is named \"end wall\"")]
    NoEndWall {
        /// Name of the scene.
        scene: String,
    },
    /// The ball would fall at once.
    #[error("scene \"{scene}\": no ground under the ball: a rectangle or half-space, level")]
    NoGround {
        /// Name of the scene.
        scene: String,
    },
    /// The ball would not roll.
    #[error("scene \"{scene}\": the forces do not pull the ball down")]
    NoGravity {
        /// Name of the scene.
        scene: String,
    },
    /// A random maze of no size, or too large to be played.
    #[error("a random maze has 2 to {most} columns and rows, not {columns} x {rows}")]
    Size {
        /// Columns requested.
        columns: usize,
        /// Rows requested.
        rows: usize,
        /// The most of each.
        most: usize,
    },
    /// The scene itself makes no sense.
    #[error(transparent)]
    Scene(#[from] SceneError),
}

fn at(place: &Option<(usize, usize)>) -> impl fmt::Display + use<> {
    place.map_or(String::new(), |(line, column)| format!(":{line}:{column}"))
}

impl TextProblem {
    /// The error of a text; a place is line and column, from 1.
    pub(crate) fn at(self, name: &str, place: impl Into<Option<(usize, usize)>>) -> MazeError {
        MazeError::Text { name: name.to_owned(), place: place.into(), problem: self }
    }
}

/// Why a game cannot be played, or not this frame. The game is then as it was.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum GameError {
    /// An option that makes no sense.
    #[error("`{field}` must be {requirement}, not {value}")]
    Option {
        /// Name of the field of [`Options`](crate::Options).
        field: &'static str,
        /// What it must be, continuing "must be".
        requirement: &'static str,
        /// What it was.
        value: f64,
    },
    /// Steering that is not a number.
    #[error("steering must be finite, not {value}")]
    Steering {
        /// What it was.
        value: f64,
    },
    /// No game in this maze has got there.
    #[error("this is no game in this maze: {problem}")]
    Progress {
        /// What gives it away.
        problem: &'static str,
    },
    /// The scene of the maze makes no sense.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The physics refuses a frame.
    #[error(transparent)]
    Physics(#[from] carom::Error),
}

/// Why episodes cannot be played, or not go on.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum EpisodeError {
    /// An option that makes no sense.
    #[error("`{field}` must be {requirement}, not {value}")]
    Option {
        /// Name of the field of [`EpisodeOptions`](crate::EpisodeOptions) or
        /// [`Rewards`](crate::Rewards).
        field: &'static str,
        /// What it must be, continuing "must be".
        requirement: &'static str,
        /// What it was.
        value: f64,
    },
    /// Another number of things than there are balls.
    #[error("{what} must be {balls}, one for each ball, not {count}")]
    Count {
        /// What was counted.
        what: &'static str,
        /// How many there must be.
        balls: usize,
        /// How many there were.
        count: usize,
    },
    /// A ball that is not there.
    #[error("there is no ball {ball}: there are {balls}, counted from 0")]
    NoBall {
        /// The number requested.
        ball: usize,
        /// How many there are.
        balls: usize,
    },
    /// An action that is not a number.
    #[error("the action for ball {ball} must be finite, not {value}")]
    Action {
        /// Whose, from 0.
        ball: usize,
        /// What it was.
        value: f64,
    },
    /// More collectibles than can be kept account of.
    #[error("a maze for episodes has at most {most} collectibles, not {count}")]
    Collectibles {
        /// How many it has.
        count: usize,
        /// How many it may have.
        most: usize,
    },
    /// The maze makes no sense.
    #[error(transparent)]
    Maze(#[from] MazeError),
    /// The physics refuses a frame.
    #[error(transparent)]
    Physics(#[from] carom::Error),
}

/// Why there is no plan to win.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum PlanError {
    /// The ball cannot get to any end wall.
    #[error("there is no way to the end wall that is wide enough for the ball")]
    NoWay,
    /// Fewer collectibles can be reached than are wanted.
    #[error("{wanted} collectibles are wanted, but the ball can get to {reachable} only")]
    TooFewCollectibles {
        /// How many the player wants.
        wanted: usize,
        /// How many there are within reach.
        reachable: usize,
    },
    /// The maze makes no world.
    #[error("{0}")]
    Maze(String),
}
