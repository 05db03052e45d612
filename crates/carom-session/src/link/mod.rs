//! Links: addresses that reproduce a run.

mod address;
mod camera;
mod error;
mod packed;
mod parse;
mod present;
mod rule;
mod run;
mod scene;
mod time;
mod written;

pub use camera::LinkCamera;
pub use error::{LinkError, MAX_MOVES};
pub use packed::{MAX_UNPACKED, PackedError};
pub use run::{Link, LinkSource};

/// Address of the page that opens links if it is served on this machine.
pub const LOCAL_PAGE: &str = "http://127.0.0.1:8042/";
