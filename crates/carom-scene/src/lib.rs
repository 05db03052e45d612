//! Scene files of Carom and recordings of what happens in them.
//!
//! A [`Scene`] is the checked content of a TOML file ([`scene`]); [`Scene::world`] creates a
//! [`carom::World`] from it. A [`Library`] finds scenes by name: built-in ones, those in folders,
//! and those registered in code. [`part`] reads single bodies and forces for a running world.
//! `recording` (feature `recording`) writes trajectories and impacts, and plays trajectories back.
//! A [`Palette`] holds the colours of a scene. [`import`] holds the common parts of imports from
//! other formats.
//!
//! ```
//! let (scene, _) = carom_scene::Library::new().find("simtest1", &[])?;
//! let mut world = scene.world()?;
//! world.step(scene.simulation.frame_time)?;
//! assert_eq!(world.spheres().len(), 1);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![warn(clippy::unwrap_used)]

mod bodies;
mod budget;
mod builtin;
mod changed_file;
mod check;
#[cfg(feature = "checkpoint")]
mod checkpoint;
mod color_text;
mod deserialize;
mod error;
mod expand;
mod force;
mod formula;
mod generate;
pub mod import;
mod legible;
mod library;
mod load;
mod materials;
mod mesh_file;
mod meshes;
mod motion;
mod origin;
pub mod outline;
mod overlap;
mod overrides;
pub mod pack;
mod palette;
mod parameters;
pub mod part;
mod plain_text;
#[cfg(feature = "recording")]
pub mod recording;
mod remarks;
mod requirement;
pub mod scene;
mod schema;
mod settings;
mod springs;
mod strike;
mod table;
mod text;
mod track;
mod tries;
pub mod unfinished;
mod units;
mod wording;
mod world;

pub use budget::Budget;
pub use builtin::FILES as BUILT_IN_FILES;
pub use changed_file::ChangedFile;
#[cfg(feature = "checkpoint")]
pub use checkpoint::{Checkpoint, CheckpointError};
pub use error::{Fault, SceneError};
pub use legible::{legible, steers};
pub use library::{Entry, Library, Source};
pub use meshes::remarks as mesh_remarks;
pub use overrides::Override;
pub use palette::{Coat, Paint, Palette};
pub use parameters::Parameter;
pub use plain_text::{NotText, text_of};
pub use remarks::remarks;
pub use scene::Scene;
pub use schema::json_schema;
pub use text::{SceneText, from_toml_text};
pub use tries::Tried;

/// The program of the README, compiled and run as a documentation test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
