//! Imports scenes of Unity.
//!
//! ```text
//!  .unity, .prefab -> documents -> objects (instances of prefabs filled in) -> nodes (placed in the world)
//!  .meta -> project (guid to file)                                               |
//!  fields of scripts -> mapping -----------------------------------------------> Scene and omissions
//! ```
//!
//! [`import`] reads one scene; a [`Project`] finds the files to which it refers. Parts without a
//! counterpart are reported ([`Omission`]), and broken files are refused with the line
//! ([`ImportError`]).

#![warn(clippy::unwrap_used)]

mod build;
mod class;
mod document;
mod error;
mod graph;
mod look;
mod mapping;
mod material;
mod model;
mod modification;
mod parts;
mod physics;
mod placed;
mod pose;
mod prefab;
mod project;
mod scene;
mod script;
mod shape;
mod value;
mod walls;

pub use carom_scene::import::Omission;
pub use error::ImportError;
pub use mapping::Mapping;
pub use project::Project;
pub use scene::{Imported, Options, import};
