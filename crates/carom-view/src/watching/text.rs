//! Reloads the text of a scene, also with other parameters.

use std::path::Path;

use carom_scene::scene::Simulation;
use carom_scene::{Parameter, SceneError};
use carom_session::{Command, SessionError};

use super::Watching;
use super::sides::side_of;
use crate::written_scene::WrittenScene;

impl Watching {
    /// Sets the text that the scene was read from, if it describes the same scene.
    pub fn set_written(&mut self, written: WrittenScene) {
        if *written.scene() == *self.view().scene {
            self.link.1 = written.link();
            self.written = Some(written);
            self.shows_text = true;
        }
    }

    /// Returns the parameters of the scene's text; none if the view shows another scene.
    pub(super) fn parameters(&self) -> Vec<Parameter> {
        let written = self.written.as_ref().filter(|_| self.shows_text);
        written.map_or_else(Vec::new, |it| it.parameters().to_vec())
    }

    /// Restarts the scene with a new value of a parameter of its file.
    pub(super) fn set_parameter(&mut self, parameter: &Parameter) {
        let Some(written) = &self.written else { return };
        match written.with(parameter) {
            Ok(written) => self.restart_from(written),
            Err(error) => self.refused = Some(SessionError::from(error)),
        }
    }

    /// Reloads the scene file; keeps camera, panels and changed parameters.
    pub fn read_anew(&mut self, path: &Path) -> Result<(), SceneError> {
        let overrides = self.written.as_ref().map_or_else(Vec::new, |it| it.overrides().to_vec());
        // The file may no longer have a changed parameter.
        let written = WrittenScene::from_file(path, overrides)
            .or_else(|_| WrittenScene::from_file(path, Vec::new()))?;
        self.restart_from(written);
        Ok(())
    }

    /// Restarts with the scene of a text; a comparison keeps its two rules.
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
