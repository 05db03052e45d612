//! Errors of mazes, with messages that say how to fix them.

use std::fmt;

use carom_scene::SceneError;
use thiserror::Error;

use crate::text_problem::TextProblem;

/// Why a scene or text is no maze.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum MazeError {
    /// A drawing is invalid.
    #[error("{name}{}: {problem}", at(.place))]
    Text {
        /// Name of the drawing.
        name: String,
        /// Line and column in the text, each from 1; `None` if the error concerns the whole
        /// drawing.
        place: Option<(usize, usize)>,
        /// The problem.
        problem: TextProblem,
    },
    /// The scene does not have exactly one ball.
    #[error("scene \"{scene}\": a maze has one sphere, the ball, not {count}")]
    OneBall {
        /// Name of the scene.
        scene: String,
        /// Number of spheres in the scene; generators and emitters count too.
        count: usize,
    },
    /// The maze has no end wall.
    #[error("scene \"{scene}\": no solid collider is named \"end wall\"")]
    NoEndWall {
        /// Name of the scene.
        scene: String,
    },
    /// There is no ground under the ball.
    #[error("scene \"{scene}\": no ground under the ball: a rectangle or half-space, level")]
    NoGround {
        /// Name of the scene.
        scene: String,
    },
    /// The forces do not pull the ball down.
    #[error("scene \"{scene}\": the forces do not pull the ball down")]
    NoGravity {
        /// Name of the scene.
        scene: String,
    },
    /// The size of a random maze is too small or too large.
    #[error("a random maze has 2 to {most} columns and rows, not {columns} x {rows}")]
    Size {
        /// Columns requested.
        columns: usize,
        /// Rows requested.
        rows: usize,
        /// Largest number of each.
        most: usize,
    },
    /// The scene itself is invalid.
    #[error(transparent)]
    Scene(#[from] SceneError),
}

fn at(place: &Option<(usize, usize)>) -> impl fmt::Display + use<> {
    place.map_or(String::new(), |(line, column)| format!(":{line}:{column}"))
}

impl TextProblem {
    /// Returns the error of a text at a place, which is line and column from 1.
    pub(crate) fn at(self, name: &str, place: impl Into<Option<(usize, usize)>>) -> MazeError {
        MazeError::Text { name: name.to_owned(), place: place.into(), problem: self }
    }
}

/// Why a game cannot be played, or a frame not taken. The game is then unchanged.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum GameError {
    /// An option is invalid.
    #[error("`{field}` must be {requirement}, not {value}")]
    Option {
        /// Name of the field of [`Options`](crate::Options).
        field: &'static str,
        /// The requirement, which continues "must be".
        requirement: &'static str,
        /// The value.
        value: f64,
    },
    /// The steering is not finite.
    #[error("steering must be finite, not {value}")]
    Steering {
        /// The value.
        value: f64,
    },
    /// The progress does not belong to a game in this maze.
    #[error("the progress does not fit this maze: {problem}")]
    Progress {
        /// The contradiction.
        problem: &'static str,
    },
    /// The scene of the maze is invalid.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The physics refused a frame.
    #[error(transparent)]
    Physics(#[from] carom::Error),
}

/// Why episodes cannot be played or continued.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum EpisodeError {
    /// An option is invalid.
    #[error("`{field}` must be {requirement}, not {value}")]
    Option {
        /// Name of the field of [`EpisodeOptions`](crate::EpisodeOptions) or
        /// [`Rewards`](crate::Rewards).
        field: &'static str,
        /// The requirement, which continues "must be".
        requirement: &'static str,
        /// The value.
        value: f64,
    },
    /// A number of values differs from the number of balls.
    #[error("{what} must be {balls}, one for each ball, not {count}")]
    Count {
        /// The counted values.
        what: &'static str,
        /// Number of balls.
        balls: usize,
        /// Number of values.
        count: usize,
    },
    /// No ball has this index.
    #[error("there is no ball {ball}: there are {balls}, counted from 0")]
    NoBall {
        /// The requested index.
        ball: usize,
        /// Number of balls.
        balls: usize,
    },
    /// An action is not finite.
    #[error("the action for ball {ball} must be finite, not {value}")]
    Action {
        /// Index of the ball, from 0.
        ball: usize,
        /// The value.
        value: f64,
    },
    /// The maze has more collectibles than episodes can count.
    #[error("a maze for episodes has at most {most} collectibles, not {count}")]
    Collectibles {
        /// Number of collectibles.
        count: usize,
        /// Largest number.
        most: usize,
    },
    /// The maze is invalid.
    #[error(transparent)]
    Maze(#[from] MazeError),
    /// The physics refused a frame.
    #[error(transparent)]
    Physics(#[from] carom::Error),
}

/// Why there is no plan to win.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum PlanError {
    /// The ball can reach no end wall.
    #[error("there is no way to the end wall that is wide enough for the ball")]
    NoWay,
    /// Fewer collectibles can be reached than the player wants.
    #[error("{wanted} collectibles are wanted, but the ball can get to {reachable} only")]
    TooFewCollectibles {
        /// Number that the player wants.
        wanted: usize,
        /// Number that can be reached.
        reachable: usize,
    },
    /// The maze's scene makes no world.
    #[error("{0}")]
    Maze(String),
}
