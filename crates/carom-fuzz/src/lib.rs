//! Hostile input for every reader of Carom, and worlds that are hard to step.
//!
//! A [`Target`] says how its cases are drawn, and what must hold of each: no panic, an end within
//! [`PATIENCE`], little memory, errors of one line that steer no terminal, and the laws of the engine.
//! A [`Campaign`] draws cases by number, so that each can be had again, and makes those that fail
//! smaller. Cases that once failed lie in the corpus.

mod campaign;
mod case;
mod corpus;
mod fault;
mod laws;
mod memory;
mod mutation;
mod stopwatch;
mod target;
mod targets;

pub use campaign::{Campaign, Finding, Totals};
pub use corpus::Known;
pub use fault::Fault;
pub use memory::MOST_BYTES;
pub use target::{Answer, PATIENCE, Target};
pub use targets::TARGETS;

/// The programs of the README of the repository, compiled and run as documentation tests: here, for a published crate holds
/// its own files only.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;

/// The programs of the guide for games.
#[cfg(doctest)]
#[doc = include_str!("../../../docs/games.md")]
struct Games;
