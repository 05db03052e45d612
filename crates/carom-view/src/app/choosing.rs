//! The chooser over the present scene, which stops meanwhile.

use carom_session::Command;
use egui::Context;

use super::App;
use crate::chooser::Chosen;
use crate::host::ReadFile;

impl App {
    /// Opens the chooser over a scene, which plays once the chooser is closed.
    pub(super) fn welcome(&mut self) {
        let entries = self.library.entries().unwrap_or_default();
        if let Some((scene, source)) =
            entries.into_iter().find_map(|it| Some((it.scene.ok()?, it.source)))
        {
            self.watch(scene, source);
            self.resumes = true;
        }
        self.open_chooser();
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
        match self.chooser.show(context, &mut self.studio) {
            Some(Chosen::Scene(scene, source)) => {
                self.open(*scene, source);
                self.command(Command::Play);
            }
            Some(Chosen::File(path)) => self.inbox.put(ReadFile::from_disk(&path)),
            Some(Chosen::AnyFile) => self.host.open_file(&self.inbox),
            None => {}
        }
        if self.resumes && !self.chooser.is_open() {
            self.resumes = false;
            self.command(Command::Play);
        }
    }
}
