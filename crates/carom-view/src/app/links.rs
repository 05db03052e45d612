//! Makes links to the present view, and opens links.

use carom_session::{Command, Link};

use super::{App, Screen};
use crate::watching::Watching;

impl App {
    /// Opens the run of a link. A game without past changes is played, anything else is watched. If
    /// the link cannot be opened, an error is shown, in the chooser if nothing else is open.
    pub fn follow(&mut self, link: &Link) {
        let scene = match link.open_within(self.link_budget) {
            Ok(scene) => scene,
            Err(error) => return self.refuse_link(&error.to_string()),
        };
        let is_beginning = link.time().is_none() && link.changes().is_empty();
        if is_beginning && self.play_scene(&scene, || link.clone()) {
            return;
        }
        match Watching::replay(link, scene, self.inline_budget, &self.context) {
            Ok(mut watching) => {
                watching.set_layout(self.saved.layout);
                self.show(Screen::Watching(Box::new(watching)));
            }
            Err(error) => self.refuse_link(&error.to_string()),
        }
    }

    /// Shows why a link cannot be opened: in the chooser if nothing was chosen yet, else as a notice.
    pub fn refuse_link(&mut self, why: &str) {
        if matches!(self.screen, Screen::Empty) {
            self.welcome();
        }
        if self.chooser.is_strip() {
            self.open_chooser();
        }
        if self.chooser.is_open() {
            self.chooser.complain(why);
        } else {
            self.notices.complain(why);
        }
    }

    /// Opens or closes the dialog with a link to the present view. Opening it pauses the scene.
    pub(super) fn open_link(&mut self) {
        self.link.toggle();
        if let Screen::Watching(watching) = &mut self.screen
            && self.link.is_open()
        {
            watching.commands.extend([Command::Pause, Command::ShowStateHash(true)]);
        }
    }

    /// Reports the link to the present view to the host, and shows it in its dialog.
    pub(super) fn links(&mut self) {
        let Self { address, link, host, context, screen, .. } = self;
        match screen {
            Screen::Watching(watching) => {
                let (view, base) = watching.linked();
                address.tell(view, base, &mut **host, context);
                let link_text = || format!("{}#{}", host.page(), base.at(view));
                link.show(context, Some((view, base)), link_text);
            }
            screen => match screen.game() {
                Some(game) => {
                    link.show(context, None, || format!("{}#{}", host.page(), game.challenge()));
                }
                None => link.close(),
            },
        }
    }
}
