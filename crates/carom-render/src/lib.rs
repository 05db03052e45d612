//! Draws spheres and surfaces: into a window, a page, or offscreen into pictures and films.

#![warn(clippy::unwrap_used)]

mod picture;

pub use picture::Picture;
