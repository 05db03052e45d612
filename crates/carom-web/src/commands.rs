//! Methods with which scripts control the watched scene.

use carom::SphereId;
use carom_session::{Command, Edit};
use wasm_bindgen::prelude::*;

use crate::Page;

#[wasm_bindgen]
impl Page {
    /// Resumes the simulation.
    pub fn play(&self) {
        self.command(Command::Play);
    }

    /// Pauses the simulation.
    pub fn pause(&self) {
        self.command(Command::Pause);
    }

    /// Seeks to the frame nearest to a time \[s\].
    pub fn seek(&self, time: f64) {
        self.command(Command::Seek(time));
    }

    /// Picks the sphere with this id, or none.
    pub fn pick(&self, id: Option<u32>) {
        self.command(Command::Pick(id.map(|id| SphereId::from_number(id.into()))));
    }

    /// Makes a change at the present time. `text` has the form that links use: `change = {
    /// all-collider-restitutions = 0.5 }`. If the change is refused, the interface shows why.
    ///
    /// # Errors
    /// An `Error` with a message for the user if the text is no change.
    pub fn edit(&self, text: &str) -> Result<(), JsError> {
        let edit = Edit::from_toml(text).map_err(|problem| JsError::new(&problem))?;
        self.command(Command::Edit(edit));
        Ok(())
    }

    /// Returns the present state as a scene file, as the interface saves it; `undefined` if no
    /// scene is watched.
    pub fn scene(&self) -> Option<String> {
        let app = self.app.try_borrow().ok()?;
        Some(app.watching()?.view().scene_now().to_toml())
    }

    /// Ends the interface; the canvas keeps its last picture.
    pub fn end(self) {
        self.runner.destroy();
    }

    fn command(&self, command: Command) {
        if let Ok(mut app) = self.app.try_borrow_mut() {
            app.command(command);
            self.context.request_repaint();
        }
    }
}
