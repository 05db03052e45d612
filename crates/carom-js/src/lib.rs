//! The engine of the JavaScript package `carom`: it converts, and holds no physics.
//!
//! What users call is JavaScript (`web/package/src`), which stands on [`World`] here. Between the
//! two go numbers, text and places in memory:
//!
//! - what users describe comes as TOML, in the words of scene files, and is read and checked by
//!   `carom-scene`;
//! - descriptions go back as JSON;
//! - arrays of spheres are not copied: this side says where they lie, the other looks at the
//!   [`memory`] there, until something is added, removed or stepped.
//!
//! A refused call leaves the world as it was and throws a [`Failure`].

#![warn(clippy::unwrap_used)]

mod arrays;
mod contact_table;
mod description;
mod editing;
mod failure;
mod find;
mod frictions;
mod impact_table;
mod members;
mod next_event;
mod place;
mod snapshot;
mod springs;
mod world;

use carom_scene::{BUILT_IN_FILES, Scene};
use serde::Serialize;
use wasm_bindgen::JsValue;
use wasm_bindgen::prelude::wasm_bindgen;

pub use failure::Failure;
pub use snapshot::Snapshot;
pub use world::World;

/// The memory of this module, a `WebAssembly.Memory`: what pointers point into. When it grows, its
/// `buffer` is another one.
#[wasm_bindgen(js_name = engineMemory)]
pub fn memory() -> JsValue {
    wasm_bindgen::memory()
}

/// A built-in scene, as it is listed.
#[derive(Serialize)]
struct Listed {
    name: String,
    title: String,
    description: String,
    origin: String,
}

/// The built-in scenes as a JSON list of `name`, `title`, `description` and `origin`.
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
