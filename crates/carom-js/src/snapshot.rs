//! A world at one moment, to return to.

use std::rc::Rc;

use carom_scene::{Palette, Scene};
use wasm_bindgen::prelude::wasm_bindgen;

use crate::members::Members;

/// The state of a world at one moment.
#[wasm_bindgen]
#[derive(Debug, Clone)]
pub struct Snapshot {
    pub(crate) world: carom::Snapshot,
    pub(crate) description: Description,
}

/// What a world does not know of itself: names, kinds of force, colours.
#[derive(Debug, Clone)]
pub struct Description {
    /// What there is besides spheres. Forces and colliders are those of the world, in its order;
    /// colliders stand where they were when they were described.
    pub scene: Rc<Scene>,
    /// Colours of the spheres that the scene brings.
    pub palette: Palette,
    /// The spheres of now.
    pub members: Members,
}
