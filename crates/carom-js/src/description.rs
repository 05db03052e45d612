//! Descriptions of what a world contains.

use carom::World as Physics;
use carom_scene::Palette;
use carom_scene::scene::{Collider, Force, Scene, Sphere, Spring};
use serde::Serialize;
use wasm_bindgen::prelude::wasm_bindgen;

use crate::failure::Failure;
use crate::find;
use crate::members::Members;
use crate::world::World;

/// A value with its id.
#[derive(Serialize)]
pub struct Numbered<T> {
    pub id: u64,
    #[serde(flatten)]
    pub it: T,
}

/// Contents of the world.
#[wasm_bindgen]
impl World {
    /// Returns the scene without its spheres as JSON: names, simulation settings, forces, emitters,
    /// camera, sun, colours. Infinite numbers are `null`.
    ///
    /// # Errors
    /// Only if the engine has a fault.
    pub fn scene(&self) -> Result<String, Failure> {
        Ok(serde_json::to_string(self.described())?)
    }

    /// Returns the colliders with present poses, ids and colours as JSON.
    ///
    /// # Errors
    /// Only if the engine has a fault.
    pub fn colliders(&self) -> Result<String, Failure> {
        let fallback = self.described().colors.as_ref().and_then(|colors| colors.colliders);
        let colored = |mut collider: Collider| {
            collider.color = collider.color.or(fallback).or(Some(Palette::COLLIDER));
            collider
        };
        let ids = self.world.colliders().map(|(id, _)| id.number());
        let colliders = colliders_now(&self.world, self.described()).into_iter().map(colored);
        let list: Vec<_> = ids.zip(colliders).map(|(id, it)| Numbered { id, it }).collect();
        Ok(serde_json::to_string(&list)?)
    }

    /// Returns the forces with their ids as JSON.
    ///
    /// # Errors
    /// Only if the engine has a fault.
    pub fn forces(&self) -> Result<String, Failure> {
        let ids = self.world.forces().map(|(id, _)| id.number());
        let forces = ids.zip(&self.described().forces);
        let list: Vec<Numbered<&Force>> = forces.map(|(id, it)| Numbered { id, it }).collect();
        Ok(serde_json::to_string(&list)?)
    }

    /// Returns one sphere as JSON.
    ///
    /// # Errors
    /// [`Failure`] if it is not in the world.
    pub fn sphere(&self, id: f64) -> Result<String, Failure> {
        let (_, index) = find::sphere(&self.world, id)?;
        let material = self.described().material_name(self.world.spheres().get(index).material);
        let sphere = sphere(&self.world, &self.description.members, index);
        Ok(serde_json::to_string(&Sphere { material, ..sphere })?)
    }

    /// Returns the present world as the text of a scene file. There, time starts at 0 and emitters
    /// start again.
    #[wasm_bindgen(js_name = toToml)]
    pub fn to_toml(&self) -> String {
        let (world, members) = (&self.world, &self.description.members);
        let mut scene = self.described().clone();
        let colliders = colliders_now(world, &scene);
        scene.colliders = colliders.iter().map(|it| it.beginning_at(world.time())).collect();
        let spheres = (0..world.spheres().len()).map(|i| Sphere {
            material: scene.material_name(world.spheres().get(i).material),
            ..sphere(world, members, i)
        });
        scene.spheres = spheres.collect();
        scene.springs = Spring::all_of(world);
        // Rules that detect contacts late let spheres overlap, which a scene must allow.
        if !scene.simulation.allow_overlap && scene.world().is_err() {
            scene.simulation.allow_overlap = true;
        }
        scene.to_toml()
    }
}

/// Returns the colliders of a scene with their present poses in its world.
fn colliders_now(world: &Physics, scene: &Scene) -> Vec<Collider> {
    let described = scene.colliders.iter().zip(world.colliders());
    described.map(|(described, (_, collider))| described.now(collider)).collect()
}

/// Returns a sphere in the form of scene files.
fn sphere(world: &Physics, members: &Members, index: usize) -> Sphere {
    let sphere = world.spheres().get(index);
    Sphere::of(&sphere).painted(members.look(index))
}
