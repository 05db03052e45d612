//! Writes runs of Carom as animations in glTF 2.0, and imports scenes of glTF.
//!
//! ```text
//!  Scene, World -> nodes, meshes, bodies -+-> JSON   -+-> .glb
//!  World of each frame -> tracks ---------+-> binary -+
//!
//!  .gltf, .glb -> document, buffers -> nodes (placed in the world) -> Scene and omissions
//!                                      meshes -> forms
//! ```
//!
//! [`Animation`] records a run. [`import()`] reads a scene; parts without a counterpart are
//! reported ([`Omission`]), and broken files are refused with the place of the error
//! ([`ImportError`]). Both coordinate systems are right-handed, with y up and in m, so no
//! conversion is needed.

#![warn(clippy::unwrap_used)]

mod color;
mod document;
mod export;
mod extensions;
mod glb;
mod import;
mod rigid_body;

pub use carom_scene::import::Omission;
pub use export::{Animation, ExportError, recover_animation};
pub use import::{ImportError, Imported, Options, import};
