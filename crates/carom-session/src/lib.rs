//! Interactive simulation: a scene with its past, its edits and its measurements.
//!
//! A [`Session`] steps a scene, goes back and forth in time, and makes edits. A [`Comparison`]
//! holds two sessions at the same frame. A [`Driver`] runs either at the pace of a clock, in the
//! caller's thread or its own, executes [`Command`]s, and publishes a [`View`] with everything that
//! an interface shows.
//!
//! Nothing here draws, and only the thread of a driver reads a clock.
//!
//! ```
//! use carom_scene::Library;
//! use carom_session::{Command, Driver, Session};
//!
//! let (scene, _) = Library::new().find("simtest1", &[])?;
//! let mut driver = Driver::inline(Session::new(scene)?);
//! driver.send(Command::Play)?;
//! // Before each picture, with the time since the last one:
//! for _ in 0..60 {
//!     driver.update(1.0 / 60.0, || false);
//!     println!("{} spheres", driver.view().spheres.positions.len());
//! }
//! # assert!(driver.view().time > 0.9);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![warn(clippy::unwrap_used)]

mod aim;
mod change;
mod command;
mod comparison;
mod distance;
mod driver;
mod edit;
mod error;
pub mod figures;
mod gas;
mod history;
mod impacts;
mod link;
mod looks;
mod pace;
mod periodic;
mod player;
mod previous;
mod queue;
mod readings;
mod replay;
mod revisions;
mod series;
mod session;
mod setup;
mod subjects;
mod timetable;
mod view;
mod watched;
#[cfg(not(target_arch = "wasm32"))]
mod worker;

pub use aim::Aim;
pub use change::{Change, PastChange};
pub use command::Command;
pub use comparison::Comparison;
pub use distance::Distance;
pub use driver::Driver;
pub use edit::{Edit, SphereChange};
pub use error::SessionError;
pub use history::DEFAULT_MEMORY;
pub use impacts::{ListedImpact, REMEMBERED, energy_change_alone};
pub use link::{
    LOCAL_PAGE, Link, LinkCamera, LinkError, LinkSource, MAX_MOVES, MAX_UNPACKED, PackedError,
};
pub use pace::{FASTEST, LONGEST_DELAY, Pace, SLOWEST};
pub use readings::{PickedReading, RATE_WINDOW, Reading};
pub use replay::Replay;
pub use series::MAX_POINTS;
pub use session::Session;
pub use setup::{Setup, group_name};
pub use view::{MARKED, Playback, SphereArrays, View};
pub use watched::Watched;
