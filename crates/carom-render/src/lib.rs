//! Draws spheres and surfaces: into a window, a page, or offscreen into pictures and films.

#![warn(clippy::unwrap_used)]

#[cfg(feature = "film")]
mod film;
#[cfg(not(target_arch = "wasm32"))]
mod new_file;
mod picture;
mod stamp;
#[cfg(feature = "film")]
mod yuv;

#[cfg(feature = "film")]
pub use film::{Film, FilmError, FilmSummary};
pub use picture::{Picture, PictureError};
pub use stamp::stamp;
