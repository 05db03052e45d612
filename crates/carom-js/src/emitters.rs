//! Emitters, in JSON and in descriptions.

use carom::Emitter;
use carom_scene::part::{self, only};
use carom_scene::scene::{self, Scene};
use wasm_bindgen::prelude::wasm_bindgen;

use crate::description::Numbered;
use crate::failure::Failure;
use crate::find;
use crate::world::World;

#[wasm_bindgen]
impl World {
    /// Returns the emitters with their ids as JSON.
    ///
    /// # Errors
    /// Only if the engine has a fault.
    pub fn emitters(&self) -> Result<String, Failure> {
        let ids = self.world.emitters().map(|(id, _)| id.number());
        let emitters = ids.zip(&self.described().emitters);
        let list: Vec<Numbered<&scene::Emitter>> =
            emitters.map(|(id, it)| Numbered { id, it }).collect();
        Ok(serde_json::to_string(&list)?)
    }

    /// Adds the emitter that `text` describes. Returns its id.
    ///
    /// # Errors
    /// [`Failure`] if it is invalid.
    #[wasm_bindgen(js_name = addEmitter)]
    pub fn add_emitter(&mut self, text: &str) -> Result<f64, Failure> {
        let part = part::read_for(text, self.described())?;
        let (emitter, described) = (emitter_of(&part)?, only(&part.emitters)?);
        let (id, time) = (self.world.add_emitter(emitter)?, self.world.time());
        self.description.palette.add_emitter(described, time);
        self.described_mut().emitters.push(described.clone());
        Ok(id.number() as f64)
    }

    /// Replaces an emitter by the one in `text`; it keeps its id.
    ///
    /// # Errors
    /// [`Failure`] if there is no such emitter or the description is invalid.
    #[wasm_bindgen(js_name = setEmitter)]
    pub fn set_emitter(&mut self, id: f64, text: &str) -> Result<(), Failure> {
        let (id, place) = find::emitter(&self.world, id)?;
        let part = part::read_for(text, self.described())?;
        let (emitter, described) = (emitter_of(&part)?, only(&part.emitters)?);
        self.world.set_emitter(id, emitter)?;
        let time = self.world.time();
        self.description.palette.set_emitter(place, described, time);
        self.described_mut().emitters[place].clone_from(described);
        Ok(())
    }

    /// Removes an emitter; its spheres stay.
    ///
    /// # Errors
    /// [`Failure`] if there is no such emitter.
    #[wasm_bindgen(js_name = removeEmitter)]
    pub fn remove_emitter(&mut self, id: f64) -> Result<(), Failure> {
        let (id, place) = find::emitter(&self.world, id)?;
        self.world.remove_emitter(id)?;
        let time = self.world.time();
        self.description.palette.remove_emitter(place, time);
        self.described_mut().emitters.remove(place);
        Ok(())
    }
}

/// Returns the only emitter of a part.
fn emitter_of(part: &Scene) -> Result<Emitter, Failure> {
    let emitters: Vec<Emitter> = part.world()?.emitters().map(|(_, emitter)| *emitter).collect();
    Ok(*only(&emitters)?)
}
