//! The C interface of Carom, declared in `include/carom.h`: conversions only, no physics.
//!
//! - A program holds worlds, snapshots and paths by handles (`handle`). A handle is never reused, so that
//!   a stale one is an error.
//! - Each function returns a [`CaromStatus`]; the message of the last error is stored per thread
//!   (`status`). No panic leaves a function.
//! - One module reads and writes memory of the program (`pointer`) and refuses null.
//!
//! `cargo xtask header` writes the header from the comments here. C programmers read them, so units
//! stand in plain brackets.

#![warn(clippy::unwrap_used)]
#![allow(rustdoc::broken_intra_doc_links)]
#![allow(
    clippy::missing_safety_doc,
    reason = "the header says at its top, once for all functions, what pointers must be"
)]

mod accounts;
mod collider;
mod collider_motion;
mod described;
mod emitter;
mod force;
mod handle;
mod listing;
mod measures;
mod mesh;
mod motion;
mod path;
mod pointer;
mod quantity;
mod query;
mod report;
mod scene;
mod snapshot;
mod sphere;
mod spring;
mod status;
mod step;
mod strike;
mod version;
mod world;

pub use accounts::*;
pub use collider::*;
pub use collider_motion::*;
pub use emitter::*;
pub use force::*;
pub use listing::*;
pub use measures::*;
pub use mesh::*;
pub use motion::*;
pub use path::*;
pub use quantity::*;
pub use query::*;
pub use report::*;
pub use scene::*;
pub use snapshot::*;
pub use sphere::*;
pub use spring::*;
pub use status::*;
pub use step::*;
pub use strike::*;
pub use version::*;
pub use world::*;
