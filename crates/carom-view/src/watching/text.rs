//! The text that a scene was read from: read anew, or with other parameters.

use std::path::Path;

use carom_scene::{Parameter, SceneError};
use carom_session::{Command, SessionError};

use super::Watching;
use crate::written_scene::WrittenScene;

impl Watching {
    /// The scene was read from this text, unless that comes to another one.
    pub fn set_written(&mut self, written: WrittenScene) {
        if *written.scene() == *self.view().scene {
            self.link.1 = written.link();
            self.written = Some(written);
        }
    }

    /// Begins the scene anew with another value of a parameter of its file.
    pub(super) fn change(&mut self, parameter: &Parameter) {
        let Some(written) = &self.written else { return };
        match written.with(parameter) {
            Ok(written) => self.begin(written),
            Err(error) => self.refused = Some(SessionError::from(error)),
        }
    }

    /// Reads the file of the scene anew, without losing camera and panels.
    pub fn read_anew(&mut self, path: &Path) -> Result<(), SceneError> {
        self.begin(WrittenScene::from_file(path)?);
        Ok(())
    }

    /// Begins with what a text comes to.
    fn begin(&mut self, written: WrittenScene) {
        self.commands.push(Command::Open(Box::new(written.scene().clone())));
        self.written = Some(written);
    }
}
