//! Drawing: the commands `picture` and `record`, the maze game without its window, and the parts
//! that Python uses.
//!
//! A *footage* draws its picture at any time: a scene that is stepped, a recording, or a game. A
//! *studio* turns these into pictures from the camera that the user chose; a film is a sequence of
//! them.

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

pub use args::PictureOptions;
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
