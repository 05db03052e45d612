//! Changes of a world.

use carom::Collider;
use carom_scene::Palette;
use carom_scene::part::{self, only};
use carom_scene::scene::{self, Force};
use serde::Serialize;
use wasm_bindgen::prelude::wasm_bindgen;

use crate::failure::Failure;
use crate::find;
use crate::world::World;

/// Ids of added parts.
#[derive(Debug, Default, Serialize)]
struct Added {
    spheres: Vec<u64>,
    colliders: Vec<u64>,
    forces: Vec<u64>,
}

/// Additions.
#[wasm_bindgen]
impl World {
    /// Adds the spheres, generators, colliders and forces that `text` describes. Returns their ids
    /// as JSON.
    ///
    /// # Errors
    /// [`Failure`] if any of them is invalid; then none is added.
    pub fn add(&mut self, text: &str) -> Result<String, Failure> {
        let mut part = part::read_for(text, self.described())?;
        part.colors.clone_from(&self.described().colors);
        let (world, palette) = (part.world()?, Palette::new(&part)?);
        let mut added = Added::default();
        // Everything has been checked: nothing below fails.
        self.add_forces(&part.forces, &mut added)?;
        self.add_colliders(&part.all_colliders(), &world, &mut added)?;
        self.add_spheres(&world, &palette, &mut added)?;
        Ok(serde_json::to_string(&added)?)
    }
}

impl World {
    fn add_forces(&mut self, forces: &[Force], added: &mut Added) -> Result<(), Failure> {
        for force in forces {
            added.forces.push(force.add_to(&mut self.world)?.number());
            self.described_mut().forces.push(force.clone());
        }
        Ok(())
    }

    /// Adds the colliders of another world, with their descriptions.
    fn add_colliders(
        &mut self,
        described: &[scene::Collider],
        world: &carom::World,
        added: &mut Added,
    ) -> Result<(), Failure> {
        for ((_, collider), described) in world.colliders().zip(described) {
            added.colliders.push(self.world.add_collider(collider.clone())?.number());
            self.described_mut().colliders.push(described.clone());
        }
        Ok(())
    }

    /// Adds the spheres of another world with their colours.
    fn add_spheres(
        &mut self,
        world: &carom::World,
        palette: &Palette,
        added: &mut Added,
    ) -> Result<(), Failure> {
        let (spheres, before) = (world.spheres(), self.world.spheres().len());
        for (index, id) in spheres.ids().iter().enumerate() {
            let (radius, mass) = (spheres.radii()[index], spheres.masses()[index]);
            let coat = palette.sphere(id.number(), radius, mass);
            let id = self.world.add_sphere(spheres.get(index))?;
            self.description.palette.add_sphere(id.number(), coat.into());
            self.description.members.add(id, coat);
            added.spheres.push(id.number());
        }
        self.description.members.follow_frictions(self.world.spheres(), before);
        Ok(())
    }
}

/// Changes and removals. An id that does not exist is refused.
#[wasm_bindgen]
impl World {
    /// Replaces the properties of a sphere by those in `text`.
    ///
    /// # Errors
    /// [`Failure`] if the sphere is not in the world or the description is invalid.
    #[wasm_bindgen(js_name = setSphere)]
    pub fn set_sphere(&mut self, id: f64, text: &str) -> Result<(), Failure> {
        let (id, index) = find::sphere(&self.world, id)?;
        let part = part::read_for(text, self.described())?;
        let world = part.world()?;
        only(world.spheres().ids())?;
        self.world.set_sphere(id, world.spheres().get(0))?;
        self.description.members.follow_frictions(self.world.spheres(), index);
        if let Some(sphere) = part.spheres.first() {
            self.description.palette.paint(id.number(), sphere.into());
            self.description.members.paint(index, sphere.into());
        }
        Ok(())
    }

    /// Removes a sphere.
    ///
    /// # Errors
    /// [`Failure`] if it is not in the world.
    #[wasm_bindgen(js_name = removeSphere)]
    pub fn remove_sphere(&mut self, id: f64) -> Result<(), Failure> {
        let (id, index) = find::sphere(&self.world, id)?;
        self.world.remove_sphere(id)?;
        self.description.members.remove(index);
        self.description.members.follow_frictions(self.world.spheres(), index);
        Ok(())
    }

    /// Replaces a collider by the one in `text`; it keeps its id.
    ///
    /// # Errors
    /// [`Failure`] if there is no such collider or the description is invalid.
    #[wasm_bindgen(js_name = setCollider)]
    pub fn set_collider(&mut self, id: f64, text: &str) -> Result<(), Failure> {
        let (id, place) = find::collider(&self.world, id)?;
        let part = part::read_for(text, self.described())?;
        let world = part.world()?;
        let colliders: Vec<Collider> =
            world.colliders().map(|(_, collider)| collider.clone()).collect();
        self.world.set_collider(id, only(&colliders)?.clone())?;
        self.described_mut().colliders[place].clone_from(only(&part.colliders)?);
        Ok(())
    }

    /// Removes a collider.
    ///
    /// # Errors
    /// [`Failure`] if there is no such collider.
    #[wasm_bindgen(js_name = removeCollider)]
    pub fn remove_collider(&mut self, id: f64) -> Result<(), Failure> {
        let (id, place) = find::collider(&self.world, id)?;
        self.world.remove_collider(id)?;
        self.described_mut().colliders.remove(place);
        Ok(())
    }

    /// Replaces a force by the one in `text`; it keeps its id.
    ///
    /// # Errors
    /// [`Failure`] if there is no such force or the description is invalid.
    #[wasm_bindgen(js_name = setForce)]
    pub fn set_force(&mut self, id: f64, text: &str) -> Result<(), Failure> {
        let (id, place) = find::force(&self.world, id)?;
        let part = part::read(text)?;
        let force = only(&part.forces)?;
        force.replace_in(&mut self.world, id)?;
        self.described_mut().forces[place].clone_from(force);
        Ok(())
    }

    /// Removes a force.
    ///
    /// # Errors
    /// [`Failure`] if there is no such force.
    #[wasm_bindgen(js_name = removeForce)]
    pub fn remove_force(&mut self, id: f64) -> Result<(), Failure> {
        let (id, place) = find::force(&self.world, id)?;
        self.world.remove_force(id)?;
        self.described_mut().forces.remove(place);
        Ok(())
    }

    /// Sets the simulation settings from `text`.
    ///
    /// # Errors
    /// [`Failure`] if the settings are invalid.
    #[wasm_bindgen(js_name = setSimulation)]
    pub fn set_simulation(&mut self, text: &str) -> Result<(), Failure> {
        let part = part::read_simulation(text)?;
        self.world.set_settings(part.settings())?;
        self.described_mut().simulation = part.simulation;
        Ok(())
    }

    /// Sets the pairs of materials, which are those of the scene, from `text`.
    ///
    /// # Errors
    /// [`Failure`] if the pairs are invalid, or of materials that the scene does not have.
    #[wasm_bindgen(js_name = setMaterialPairs)]
    pub fn set_material_pairs(&mut self, text: &str) -> Result<(), Failure> {
        let (described, pairs) = part::material_pairs(text, self.described())?;
        self.world.set_material_pairs(pairs)?;
        self.described_mut().material_pairs = described;
        Ok(())
    }
}
