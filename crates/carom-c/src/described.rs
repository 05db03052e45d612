//! Data about a world besides its physics, which snapshots carry to other programs.

use std::sync::Arc;

use carom::World;
use carom_scene::scene::{Collider, Force};
use carom_scene::{Palette, Scene};

use crate::status::Failure;

/// Names, colours and the like of a world. Copies share what is not changed.
#[derive(Debug, Clone)]
pub(crate) struct Described {
    /// The scene without spheres. Its forces, colliders and emitters have the order of the world;
    /// colliders have the poses of their descriptions.
    scene: Arc<Scene>,
    palette: Arc<Palette>,
}

impl Described {
    /// Makes the world of a scene and its description.
    pub fn of(mut scene: Scene) -> Result<(World, Self), Failure> {
        let world = scene.world()?;
        let palette = Palette::new(&scene)?;
        scene.spheres.clear();
        scene.colliders = scene.all_colliders().into_owned();
        scene.generators.clear();
        scene.springs.clear();
        Ok((world, Self::new(scene, palette)))
    }

    pub fn new(scene: Scene, palette: Palette) -> Self {
        Self { scene: Arc::new(scene), palette: Arc::new(palette) }
    }

    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    pub fn palette(&self) -> &Palette {
        &self.palette
    }

    /// Returns the description for changes, which must match those of the world.
    pub fn scene_mut(&mut self) -> &mut Scene {
        Arc::make_mut(&mut self.scene)
    }

    /// Returns the colours for changes, which must match those of the world.
    pub fn palette_mut(&mut self) -> &mut Palette {
        Arc::make_mut(&mut self.palette)
    }

    /// Adds a placeholder for a force that is a function: it has no description, and its world
    /// cannot be written as bytes.
    pub fn add_function(&mut self) {
        self.scene_mut().forces.push(Force::Constant { force: [0.0; 3] });
    }

    /// Changes the colliders and updates their colours.
    pub fn change_colliders(&mut self, change: impl FnOnce(&mut Vec<Collider>)) {
        let Self { scene, palette } = self;
        let colliders = &mut Arc::make_mut(scene).colliders;
        change(colliders);
        Arc::make_mut(palette).set_colliders(colliders);
    }
}
