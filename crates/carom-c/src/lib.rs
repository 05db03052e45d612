//! The C interface of Carom: what `include/carom.h` declares. It converts, and holds no physics.
//!
//! - A program holds worlds and snapshots by handles: numbers that are given once and never again
//!   (`handle`), so that a stale one is an error.
//! - Each function ends in a [`CaromStatus`]; the message of the last error waits in the thread
//!   (`status`). No panic leaves a function.
//! - Memory of the program is read and written in one module (`pointer`), which refuses null.
//!
//! `cargo xtask header` makes the header of the comments here: they are read in C, where units stand
//! in plain brackets.

#![warn(clippy::unwrap_used)]
#![allow(rustdoc::broken_intra_doc_links)]
#![allow(
    clippy::missing_safety_doc,
    reason = "the header says at its top, once for all functions, what pointers must be"
)]

mod collider;
mod described;
mod force;
mod handle;
mod listing;
mod measures;
mod pointer;
mod quantity;
mod report;
mod scene;
mod snapshot;
mod sphere;
mod spring;
mod status;
mod step;
mod version;
mod world;

pub use collider::*;
pub use force::*;
pub use listing::*;
pub use measures::*;
pub use quantity::*;
pub use report::*;
pub use scene::*;
pub use snapshot::*;
pub use sphere::*;
pub use spring::*;
pub use status::*;
pub use step::*;
pub use version::*;
pub use world::*;
