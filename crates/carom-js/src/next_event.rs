//! Steps that end at the next impact.

use wasm_bindgen::prelude::wasm_bindgen;

use crate::failure::Failure;
use crate::world::World;

#[wasm_bindgen]
impl World {
    /// Returns the time of the next impact \[s\], if it is within `within` \[s\].
    ///
    /// # Errors
    /// [`Failure`] as [`carom::World::next_event_time`].
    #[wasm_bindgen(js_name = nextEventTime)]
    pub fn next_event_time(&self, within: f64) -> Result<Option<f64>, Failure> {
        Ok(self.world.next_event_time(within)?)
    }

    /// Advances the world to its next impact, at most by `within` \[s\].
    ///
    /// # Errors
    /// [`Failure`] as [`carom::World::step_to_next_event`]; the state before the step is kept.
    #[wasm_bindgen(js_name = stepToNextEvent)]
    pub fn step_to_next_event(&mut self, within: f64) -> Result<(), Failure> {
        self.take_step(|world| world.step_to_next_event(within).map(drop))
    }
}
