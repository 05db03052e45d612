//! The engine of the JavaScript package `carom`: conversions only, no physics.
//!
//! Users call JavaScript (`web/package/src`), which calls [`World`] here. Three kinds of data pass
//! between them:
//!
//! - descriptions by users arrive as TOML in the format of scene files, which `carom-scene` reads
//!   and checks;
//! - descriptions return as JSON;
//! - arrays of spheres are not copied: JavaScript gets their addresses and reads the [`memory`]
//!   until the world is stepped or changed.
//!
//! A refused call leaves the world unchanged and throws a [`Failure`].

#![warn(clippy::unwrap_used)]

mod arrays;
mod contact_table;
mod description;
mod editing;
mod emitters;
mod failure;
mod find;
mod frictions;
mod impact_table;
mod measures;
mod members;
mod motion;
mod next_event;
mod place;
mod predicted_path;
mod queries;
mod snapshot;
mod springs;
mod world;

use carom_scene::{BUILT_IN_FILES, Scene};
use serde::Serialize;
use wasm_bindgen::JsValue;
use wasm_bindgen::prelude::wasm_bindgen;

pub use failure::Failure;
pub use predicted_path::Path;
pub use queries::Filter;
pub use snapshot::Snapshot;
pub use world::World;

/// Returns the memory of this module, a `WebAssembly.Memory` that addresses refer to. When it
/// grows, it gets a new `buffer`.
#[wasm_bindgen(js_name = engineMemory)]
pub fn memory() -> JsValue {
    wasm_bindgen::memory()
}

/// A built-in scene in the list.
#[derive(Serialize)]
struct Listed {
    name: String,
    title: String,
    description: String,
    origin: String,
}

/// Returns the built-in scenes as a JSON list of `name`, `title`, `description` and `origin`.
///
/// # Errors
/// [`Failure`] if a built-in scene cannot be read.
#[wasm_bindgen]
pub fn scenes() -> Result<String, Failure> {
    let read = |(file, text): &(&str, &str)| {
        let Scene { name, title, description, origin, .. } = Scene::from_toml(text, file)?;
        Ok(Listed { name, title, description, origin })
    };
    let scenes: Result<Vec<Listed>, Failure> = BUILT_IN_FILES.iter().map(read).collect();
    Ok(serde_json::to_string(&scenes?)?)
}
