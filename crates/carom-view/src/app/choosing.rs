//! The chooser over the present scene, which stops meanwhile.

use carom_session::Command;
use egui::Context;

use super::App;
use crate::chooser::Chosen;
use crate::host::ReadFile;

impl App {
    /// Plays the first scene, with the others as a strip below it. A page in a document has no space
    /// for the strip and opens the dialog.
    pub(super) fn welcome(&mut self) {
        let entries = self.library.entries().unwrap_or_default();
        if let Some((scene, source)) =
            entries.into_iter().find_map(|it| Some((it.scene.ok()?, it.source)))
        {
            self.watch(scene, source);
            self.resumes = true;
        }
        if self.host.is_embedded() {
            return self.open_chooser();
        }
        if let Err(error) = self.chooser.open_strip(&self.library, &self.saved.recent) {
            self.notices.complain(error);
        }
        // A user who wants little motion starts it.
        self.resumes &= !self.host.reduces_motion();
    }

    /// Opens the chooser, and stops the present scene.
    pub(super) fn open_chooser(&mut self) {
        // Nothing runs unseen.
        if self.watching().is_some_and(|it| it.view().playback.playing) {
            self.resumes = true;
            self.command(Command::Pause);
        }
        if let Err(error) = self.chooser.open(&self.library, &self.saved.recent) {
            self.notices.complain(error);
        }
    }

    /// Shows the chooser if it is open, and opens what was chosen. A chosen scene plays.
    pub(super) fn choose(&mut self, context: &Context) {
        if let Some(chosen) = self.chooser.show(context, &mut self.studio) {
            self.take(chosen);
        }
        if self.resumes && !self.chooser.is_open() {
            self.resumes = false;
            self.command(Command::Play);
        }
    }

    /// Opens what was chosen; a scene plays.
    pub(super) fn take(&mut self, chosen: Chosen) {
        match chosen {
            Chosen::Scene(scene, source) => {
                self.open(*scene, source);
                self.command(Command::Play);
            }
            Chosen::File(path) => self.inbox.put(ReadFile::from_disk(&path)),
            Chosen::AnyFile => self.host.open_file(&self.inbox),
        }
    }
}
