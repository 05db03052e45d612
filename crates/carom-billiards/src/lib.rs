//! The game of nine-ball: a cue, ten balls, six pockets and the rules. No drawing, no clock.
//!
//! A [`Table`] is a scene whose balls have numbers and whose colliders have roles. A [`Game`] takes [`Move`]s, advances by
//! frames while balls roll, and judges each shot. [`Rack`] has the rules alone, for shots from anywhere, and [`Referee`] reads
//! a shot from the reports of any world.
//!
//! ```
//! use carom_billiards::{Game, Move, Table};
//! use carom_scene::scene::Strike;
//!
//! let mut game = Game::new(Table::built_in()?, 2)?;
//! game.play(Move::Strike(Strike { azimuth_degrees: 0.9, ..Strike::new(8.0) }))?;
//! let verdict = loop {
//!     if let Some(verdict) = game.step()? {
//!         break verdict;
//!     }
//! };
//! assert_eq!(verdict.foul, None);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![warn(clippy::unwrap_used)]

mod error;
mod game;
mod moves;
mod nine_ball;
mod shot;
mod table;

pub use error::{GameError, MoveError, TableError};
pub use game::{Best, Game};
pub use moves::Move;
pub use nine_ball::{BallInHand, Foul, NINE, Rack, Stage, Verdict};
pub use shot::{CUE, Referee, Shot};
pub use table::Table;

/// The program of the README as a documentation test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
