//! Changing a world from outside.

use carom::Collider;
use carom_scene::Palette;
use carom_scene::part::{self, only};
use carom_scene::scene::{self, Force};
use serde::Serialize;
use wasm_bindgen::prelude::wasm_bindgen;

use crate::failure::Failure;
use crate::find;
use crate::world::World;

/// Ids of what was added.
#[derive(Debug, Default, Serialize)]
struct Added {
    spheres: Vec<u64>,
    colliders: Vec<u64>,
    forces: Vec<u64>,
}

/// Adding.
#[wasm_bindgen]
impl World {
    /// Adds the spheres, generators, colliders and forces that `text` describes, and answers with
    /// their ids as JSON.
    ///
    /// # Errors
    /// [`Failure`] if any of them makes no sense; then none is added.
    pub fn add(&mut self, text: &str) -> Result<String, Failure> {
        let mut part = part::read(text)?;
        part.colors.clone_from(&self.described().colors);
        let (world, palette) = (part.world()?, Palette::new(&part)?);
        let mut added = Added::default();
        // All is checked by now: nothing below is refused.
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

    /// Adds the colliders of another world, which are described so.
    fn add_colliders(
        &mut self,
        described: &[scene::Collider],
        world: &carom::World,
        added: &mut Added,
    ) -> Result<(), Failure> {
        for ((_, collider), described) in world.colliders().zip(described) {
            added.colliders.push(self.world.add_collider(*collider)?.number());
            self.described_mut().colliders.push(described.clone());
        }
        Ok(())
    }

    /// Adds the spheres of another world, in its colours.
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

/// Changing and removing. Ids are numbers as they were given; any other is refused.
#[wasm_bindgen]
impl World {
    /// Changes a sphere to the one that `text` describes.
    ///
    /// # Errors
    /// [`Failure`] if it is not in the world, or if the description makes no sense.
    #[wasm_bindgen(js_name = setSphere)]
    pub fn set_sphere(&mut self, id: f64, text: &str) -> Result<(), Failure> {
        let (id, index) = find::sphere(&self.world, id)?;
        let part = part::read(text)?;
        let world = part.world()?;
        only(world.spheres().ids())?;
        self.world.set_sphere(id, world.spheres().get(0))?;
        self.description.members.follow_frictions(self.world.spheres(), index);
        if let Some(sphere) = part.spheres.first() {
            self.description.members.paint(index, sphere.into());
        }
        Ok(())
    }

    /// Takes a sphere out of the world.
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

    /// Changes a collider to the one that `text` describes.
    ///
    /// # Errors
    /// [`Failure`] if there is no such collider, or if the description makes no sense.
    #[wasm_bindgen(js_name = setCollider)]
    pub fn set_collider(&mut self, id: f64, text: &str) -> Result<(), Failure> {
        let (id, place) = find::collider(&self.world, id)?;
        let part = part::read(text)?;
        let world = part.world()?;
        let colliders: Vec<Collider> = world.colliders().map(|(_, collider)| *collider).collect();
        self.world.set_collider(id, *only(&colliders)?)?;
        self.described_mut().colliders[place].clone_from(only(&part.colliders)?);
        Ok(())
    }

    /// Takes a collider out of the world.
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

    /// Puts the force that `text` describes in the place of another.
    ///
    /// # Errors
    /// [`Failure`] if there is no such force, or if the description makes no sense.
    #[wasm_bindgen(js_name = setForce)]
    pub fn set_force(&mut self, id: f64, text: &str) -> Result<(), Failure> {
        let (id, place) = find::force(&self.world, id)?;
        let part = part::read(text)?;
        let force = only(&part.forces)?;
        force.replace_in(&mut self.world, id)?;
        self.described_mut().forces[place].clone_from(force);
        Ok(())
    }

    /// Takes a force out of the world.
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

    /// Steps the world as `text` says from now on.
    ///
    /// # Errors
    /// [`Failure`] if that makes no sense.
    #[wasm_bindgen(js_name = setSimulation)]
    pub fn set_simulation(&mut self, text: &str) -> Result<(), Failure> {
        let part = part::read_simulation(text)?;
        self.world.set_settings(part.settings())?;
        self.described_mut().simulation = part.simulation;
        Ok(())
    }
}
