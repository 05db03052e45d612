//! What is known of a world besides its physics: what its snapshots tell other programs.

use std::sync::Arc;

use carom::World;
use carom_scene::scene::{Collider, Force};
use carom_scene::{Palette, Scene};

use crate::status::Failure;

/// Names, colours and the like of a world. Copies share what is not changed.
#[derive(Debug, Clone)]
pub(crate) struct Described {
    /// What there is besides spheres. Forces, colliders and emitters are those of the world, in its
    /// order; colliders stand where they were when they were described.
    scene: Arc<Scene>,
    palette: Arc<Palette>,
}

impl Described {
    /// The world of a scene, and what is known of it.
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

    /// The description, to be changed together with the world.
    pub fn scene_mut(&mut self) -> &mut Scene {
        Arc::make_mut(&mut self.scene)
    }

    /// The colours, to be changed together with the world.
    pub fn palette_mut(&mut self) -> &mut Palette {
        Arc::make_mut(&mut self.palette)
    }

    /// Adds a force that is a function: it has no description, and a world with one has no bytes.
    pub fn add_function(&mut self) {
        self.scene_mut().forces.push(Force::Constant { force: [0.0; 3] });
    }

    /// Changes the colliders, and their colours with them.
    pub fn change_colliders(&mut self, change: impl FnOnce(&mut Vec<Collider>)) {
        let Self { scene, palette } = self;
        let colliders = &mut Arc::make_mut(scene).colliders;
        change(colliders);
        Arc::make_mut(palette).set_colliders(colliders);
    }
}
