//! Draws spheres and surfaces: into a window, a page, or offscreen into pictures and films.

#![warn(clippy::unwrap_used)]

#[cfg(not(target_arch = "wasm32"))]
mod new_file;
mod picture;
mod stamp;

pub use picture::{Picture, PictureError};
pub use stamp::stamp;
