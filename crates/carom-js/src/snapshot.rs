//! Snapshots of a world.

use std::rc::Rc;

use carom_scene::{Palette, Scene};
use wasm_bindgen::prelude::wasm_bindgen;

use crate::members::Members;

/// The state of a world at one time.
#[wasm_bindgen]
#[derive(Debug, Clone)]
pub struct Snapshot {
    pub(crate) world: carom::Snapshot,
    pub(crate) description: Description,
}

/// Data about a world that its physics does not have: names, kinds of force, colours.
#[derive(Debug, Clone)]
pub struct Description {
    /// The scene without spheres. Its forces and colliders have the order of the world; colliders
    /// have the poses of their descriptions.
    pub scene: Rc<Scene>,
    /// Colours for the spheres of the scene.
    pub palette: Palette,
    /// The present spheres.
    pub members: Members,
}
