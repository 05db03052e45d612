//! A scene during the import.

use std::collections::BTreeMap;

use carom_scene::import::{Omission, plain_name};
use carom_scene::scene::{Collider, Scene, Sphere};

use super::graph::Placed;

/// A scene during the import.
#[derive(Debug)]
pub(super) struct Building {
    pub scene: Scene,
    /// Places of parts in the file, by their paths in the scene.
    pub places: BTreeMap<String, String>,
    pub report: Vec<Omission>,
}

impl Building {
    /// Creates an empty scene.
    pub fn new(name: &str) -> Self {
        Self { scene: Scene::new(plain_name(name)), places: BTreeMap::new(), report: Vec::new() }
    }

    /// Adds a sphere.
    pub fn push_sphere(&mut self, sphere: Sphere, node: &Placed) {
        self.places.insert(format!("spheres[{}]", self.scene.spheres.len()), node.place());
        self.scene.spheres.push(sphere);
    }

    /// Adds a collider.
    pub fn push_collider(&mut self, mut collider: Collider, node: &Placed) {
        collider.name.clone_from(&node.name);
        self.places.insert(format!("colliders[{}]", self.scene.colliders.len()), node.place());
        self.scene.colliders.push(collider);
    }
}
