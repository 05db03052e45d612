//! What draws: the commands `picture`, `record`, and the maze game without its window; and what
//! these are made of, for Python.
//!
//! A *footage* knows what is to be seen at any time: a scene being stepped, a recording, a game. A
//! *studio* draws that, from where the user wants to look; a film is that done many times.

pub(crate) mod args;
mod drawn;
mod error;
mod failure;
mod film;
mod footage;
mod maze;
mod picture;
mod played;
mod record;
mod replayed;
mod running;
mod shoot;
mod stepped;
mod still;
mod studio;
mod viewpoint;

pub use args::Look;
pub use error::ShootError;
pub use film::{Filming, Order};
pub use footage::{Footage, Words};
pub use stepped::Stepped;
pub use still::Still;
pub use studio::Studio;
pub use viewpoint::Viewpoint;

pub(crate) use maze::maze;
pub(crate) use picture::picture;
pub(crate) use record::record;
