//! Springs, whose ends are ids of spheres, in JSON and in descriptions.

use carom_scene::part;
use carom_scene::scene::Spring;
use wasm_bindgen::prelude::wasm_bindgen;

use crate::description::Numbered;
use crate::failure::Failure;
use crate::find;
use crate::world::World;

#[wasm_bindgen]
impl World {
    /// Returns the springs with their ids as JSON.
    ///
    /// # Errors
    /// Only if the engine has a fault.
    pub fn springs(&self) -> Result<String, Failure> {
        let numbered = |(id, it): (carom::SpringId, &carom::Spring)| {
            Some(Numbered { id: id.number(), it: Spring::by_ids(it)? })
        };
        let list: Vec<Numbered<Spring>> = self.world.springs().filter_map(numbered).collect();
        Ok(serde_json::to_string(&list)?)
    }

    /// Adds the spring that `text` describes. Returns its id.
    ///
    /// # Errors
    /// [`Failure`] if it is invalid, or if a sphere is not in the world.
    #[wasm_bindgen(js_name = addSpring)]
    pub fn add_spring(&mut self, text: &str) -> Result<f64, Failure> {
        let spring = part::spring_of(text, &self.world)?;
        Ok(self.world.add_spring(spring)?.number() as f64)
    }

    /// Replaces a spring by the one in `text`; it keeps its id.
    ///
    /// # Errors
    /// [`Failure`] if there is no such spring or sphere, or the description is invalid.
    #[wasm_bindgen(js_name = setSpring)]
    pub fn set_spring(&mut self, id: f64, text: &str) -> Result<(), Failure> {
        let id = find::spring(&self.world, id)?;
        let spring = part::spring_of(text, &self.world)?;
        Ok(self.world.set_spring(id, spring)?)
    }

    /// Removes a spring; its spheres stay.
    ///
    /// # Errors
    /// [`Failure`] if there is no such spring.
    #[wasm_bindgen(js_name = removeSpring)]
    pub fn remove_spring(&mut self, id: f64) -> Result<(), Failure> {
        let id = find::spring(&self.world, id)?;
        self.world.remove_spring(id)?;
        Ok(())
    }
}

impl From<part::SpringError> for Failure {
    fn from(error: part::SpringError) -> Self {
        match error {
            part::SpringError::Part(error) => error.into(),
            part::SpringError::World(error) => error.into(),
        }
    }
}
