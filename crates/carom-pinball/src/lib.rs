//! The pinball game: flippers keep a ball on a tilted table with bumpers and targets. No drawing, no clock.
//!
//! A [`Table`] is a scene whose colliders have roles by their names. A [`Game`] advances by frames under the player's
//! [`Keys`].
//!
//! ```
//! use carom_pinball::{Game, Keys, Table};
//!
//! let mut game = Game::new(Table::built_in()?)?;
//! for _ in 0..60 {
//!     for event in game.step(Keys { plunger: true, ..Keys::NONE })? {
//!         println!("{event:?}");
//!     }
//! }
//! assert_eq!((game.score(), game.balls()), (0, 3));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! In a frame of the game the *levers* (flippers and plunger) follow the keys, the *world* is stepped, and its report
//! yields *events* and points.

#![warn(clippy::unwrap_used)]

mod error;
mod game;
mod keys;
mod lever;
mod role;
mod table;

pub use error::{GameError, TableError};
pub use game::{Game, GameEvent, GameState};
pub use keys::Keys;
pub use role::Role;
pub use table::Table;

/// The program of the README as a documentation test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
