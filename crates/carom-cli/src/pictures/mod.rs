//! The commands that draw: `picture`, `record`, and the maze game without its window.
//!
//! A *footage* knows what is to be seen at any time: a scene being stepped, a recording, a game. A
//! *studio* draws that, from where the user wants to look; a film is that done many times.

pub mod args;
mod drawn;
mod failure;
mod film;
mod footage;
mod maze;
mod picture;
mod played;
mod record;
mod replayed;
mod running;
mod stepped;
mod studio;
mod viewpoint;

pub use maze::maze;
pub use picture::picture;
pub use record::record;
