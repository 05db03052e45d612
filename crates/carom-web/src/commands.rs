//! What scripts tell the interface to do with the scene that is watched.

use carom::SphereId;
use carom_session::{Command, Edit};
use wasm_bindgen::prelude::*;

use crate::Page;

#[wasm_bindgen]
impl Page {
    /// Lets time go on.
    pub fn play(&self) {
        self.command(Command::Play);
    }

    /// Lets time stand still.
    pub fn pause(&self) {
        self.command(Command::Pause);
    }

    /// Goes to the frame nearest to a time \[s\].
    pub fn seek(&self, time: f64) {
        self.command(Command::Seek(time));
    }

    /// Follows the sphere with this id, or none.
    pub fn pick(&self, id: Option<u32>) {
        self.command(Command::Pick(id.map(|id| SphereId::from_number(id.into()))));
    }

    /// Makes a change at the present time, as links write it:
    /// `change = { all-collider-restitutions = 0.5 }`. The interface says where it is refused.
    ///
    /// # Errors
    /// An `Error` for people about a text that is no change.
    pub fn edit(&self, text: &str) -> Result<(), JsError> {
        let edit = Edit::from_toml(text).map_err(|problem| JsError::new(&problem))?;
        self.command(Command::Edit(edit));
        Ok(())
    }

    /// The scene as it is now, as a scene file: what the interface saves. `undefined` where none is
    /// watched.
    pub fn scene(&self) -> Option<String> {
        let app = self.app.try_borrow().ok()?;
        Some(app.watching()?.view().scene_now().to_toml())
    }

    /// Ends the interface: the canvas shows its last picture from then on.
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
