//! Snapshots of a world.

use std::rc::Rc;

use carom_scene::{Checkpoint, Palette, Scene};
use wasm_bindgen::prelude::wasm_bindgen;

use crate::failure::Failure;
use crate::members::Members;

/// The state of a world at one time.
#[wasm_bindgen]
#[derive(Debug, Clone)]
pub struct Snapshot {
    pub(crate) world: carom::Snapshot,
    pub(crate) description: Description,
}

#[wasm_bindgen]
impl Snapshot {
    /// Returns the time of the snapshot \[s\].
    #[wasm_bindgen(getter)]
    pub fn time(&self) -> f64 {
        self.world.time()
    }

    /// Returns the snapshot as bytes, the same ones on every platform.
    ///
    /// # Errors
    /// [`Failure`] if there is not enough memory.
    #[wasm_bindgen(js_name = toBytes)]
    pub fn to_bytes(&self) -> Result<Vec<u8>, Failure> {
        let Description { scene, palette, .. } = &self.description;
        Checkpoint::bytes_of(&self.world, scene, palette).map_err(Failure::new)
    }

    /// Returns the snapshot from bytes of [`Self::to_bytes`].
    ///
    /// # Errors
    /// [`Failure`] if the bytes are no snapshot, of another version or damaged, or do not fit into memory.
    #[wasm_bindgen(js_name = fromBytes)]
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, Failure> {
        let checkpoint = Checkpoint::from_bytes(bytes).map_err(Failure::new)?;
        let Checkpoint { snapshot, scene, palette } = checkpoint;
        let (mut restored, mut members) = (carom::World::default(), Members::default());
        restored.restore(&snapshot);
        members.follow(restored.spheres(), &palette);
        let description = Description { scene: Rc::new(scene), palette, members };
        Ok(Self { world: snapshot, description })
    }
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
