//! The text that a scene was read from: read anew, or with other parameters.

use std::path::Path;

use carom_scene::scene::Simulation;
use carom_scene::{Parameter, SceneError};
use carom_session::{Command, SessionError};

use super::Watching;
use super::sides::side_of;
use crate::written_scene::WrittenScene;

impl Watching {
    /// The scene was read from this text, unless that comes to another one.
    pub fn set_written(&mut self, written: WrittenScene) {
        if *written.scene() == *self.view().scene {
            self.link.1 = written.link();
            self.written = Some(written);
            self.shows_text = true;
        }
    }

    /// The parameters of the text that the scene was read from; none where it is another scene by now.
    pub(super) fn parameters(&self) -> Vec<Parameter> {
        let written = self.written.as_ref().filter(|_| self.shows_text);
        written.map_or_else(Vec::new, |it| it.parameters().to_vec())
    }

    /// Begins the scene anew with another value of a parameter of its file.
    pub(super) fn set_parameter(&mut self, parameter: &Parameter) {
        let Some(written) = &self.written else { return };
        match written.with(parameter) {
            Ok(written) => self.restart_from(written),
            Err(error) => self.refused = Some(SessionError::from(error)),
        }
    }

    /// Reads the file of the scene anew, without losing camera, panels and values that differ from it.
    pub fn read_anew(&mut self, path: &Path) -> Result<(), SceneError> {
        let overrides = self.written.as_ref().map_or_else(Vec::new, |it| it.overrides().to_vec());
        // What was changed may be gone from the file.
        let written = WrittenScene::from_file(path, overrides)
            .or_else(|_| WrittenScene::from_file(path, Vec::new()))?;
        self.restart_from(written);
        Ok(())
    }

    /// Begins the scene anew as a text has it; two rules stay side by side.
    fn restart_from(&mut self, written: WrittenScene) {
        self.commands.push(Command::Open(Box::new(written.scene().clone())));
        let view = self.view();
        if view.other.is_some() {
            let pair = [0, 1].map(|side| {
                let rule = side_of(view, side).setup.simulation.rule;
                Simulation { rule, ..written.scene().simulation.clone() }
            });
            self.commands.push(Command::Compare(Some(Box::new(pair))));
        }
        self.written = Some(written);
    }
}
