//! Draws spheres and surfaces into a window, a web page, pictures and films.
//!
//! A [`Drawing`] holds the things to draw, a [`Camera`] the point of view. A [`Renderer`] draws
//! both into a [`Target`] on a wgpu device; [`Offscreen`] draws them into a [`Picture`] in memory.
//! [`draw_world`] makes a drawing of a world. Apart from that function, this crate knows neither
//! physics nor a user interface.

#![warn(clippy::unwrap_used)]

mod bounds;
mod camera;
mod container;
mod crowd;
mod cutaway;
mod drawing;
#[cfg(feature = "film")]
mod film;
#[cfg(feature = "film")]
mod film_error;
#[cfg(feature = "film")]
mod film_form;
mod fonts;
#[cfg(feature = "film")]
mod fragments;
mod framing;
mod gpu;
mod instances;
mod look;
#[cfg(not(target_arch = "wasm32"))]
mod new_file;
mod offscreen;
mod orbits;
mod picture;
mod pipelines;
#[cfg(feature = "film")]
mod plain_film;
mod preset;
mod quality;
mod readback;
mod renderer;
mod round;
mod shadow;
mod stamp;
mod surroundings;
mod target;
#[cfg(feature = "film")]
mod yuv;

pub use bounds::Bounds;
pub use camera::Camera;
pub use drawing::{Arrow, Ball, Drawing, Light, Panel, Pattern};
#[cfg(feature = "film")]
pub use film::{Film, FilmSummary};
#[cfg(feature = "film")]
pub use film_error::FilmError;
pub use fonts::TEXT_FONT;
pub use framing::Framing;
pub use gpu::{Gpu, GpuError};
pub use look::{Roll, bodies, draw_world, spring_line};
pub use offscreen::Offscreen;
pub use orbits::Body;
pub use picture::{Picture, PictureError};
#[cfg(feature = "film")]
pub use plain_film::recover_film;
pub use preset::Preset;
pub use quality::Quality;
pub use readback::Readback;
pub use renderer::Renderer;
pub use stamp::{caption, missing_characters, stamp};
pub use surroundings::add_surroundings;
pub use target::{COLOR_FORMAT, Target};
pub use wgpu;
