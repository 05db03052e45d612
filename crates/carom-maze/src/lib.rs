//! The maze game: the player tilts a floor with walls, on which a ball rolls. No drawing, no clock.
//!
//! A [`Maze`] is a scene whose colliders have roles: ground, walls, end walls, collectibles. It can
//! be the course's ([`Maze::course`]), drawn with characters ([`Maze::from_text`]) or random
//! ([`Maze::random`]). A [`Game`] advances by frames under a [`Steering`]; a [`Player`] plays by
//! itself.
//!
//! ```
//! use carom_maze::{Game, Maze, Options, Player};
//!
//! let maze = Maze::random(7, 5, 4)?;
//! let mut player = Player::new(&maze, 1)?;
//! let mut game = Game::new(maze, Options::default())?;
//! for _ in 0..60 {
//!     let steering = player.steer(&game);
//!     for event in game.step(steering)? {
//!         println!("{event:?}");
//!     }
//! }
//! assert_eq!(game.elapsed(), 1.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! In a frame of the game the *tilt* follows the steering, the *motion* of every collider takes it
//! from the old tilt to the new one, the *world* is stepped, and its report yields *events*.
//!
//! [`Episodes`] are for learning agents: many balls at once, each with its own tilt.

#![warn(clippy::unwrap_used)]

mod builtin;
mod camera;
mod cover;
mod drawing;
mod episodes;
mod error;
mod floor;
mod game;
mod grid;
mod layout;
mod maze;
mod maze_text;
mod options;
mod part;
mod player;
mod progress;
mod random;
mod route;
mod text_problem;
mod tilt;

pub use builtin::DRAWINGS as BUILT_IN_DRAWINGS;
pub use episodes::{Arena, EpisodeOptions, Episodes, Outcome, Rewards, Start};
pub use error::{EpisodeError, GameError, MazeError, PlanError};
pub use game::{Game, GameEvent, GameState};
pub use maze::{Maze, Role};
pub use options::Options;
pub use player::Player;
pub use progress::Progress;
pub use random::{MOST_CELLS_PER_SIDE, random_text};
pub use text_problem::TextProblem;
pub use tilt::{Steering, Tilt};

/// The program of the README as a documentation test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
