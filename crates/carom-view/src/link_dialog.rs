//! The dialog with a link to what is shown, for people to copy.

use carom_session::View;
use egui::{Align2, Context, TextEdit, Window};

use crate::address::Moment;

/// The dialog with a link to what is shown.
#[derive(Default)]
pub struct LinkDialog {
    open: bool,
    /// The link, and what it was made of.
    link: Option<(Option<Moment>, String)>,
}

impl LinkDialog {
    /// Opens the dialog, or closes it.
    pub fn toggle(&mut self) {
        self.open ^= true;
    }

    /// Closes the dialog.
    pub fn close(&mut self) {
        self.open = false;
    }

    /// Whether it is open.
    pub fn is_open(&self) -> bool {
        self.open
    }

    /// Shows the dialog while it is open, with a link to this view, or to something that stays the
    /// same.
    pub fn show(
        &mut self,
        context: &Context,
        view: Option<&View>,
        make_link: impl FnOnce() -> String,
    ) {
        let moment = view.map(Moment::of);
        let is_same = |(shown, _): &(Option<Moment>, String)| match (shown, &moment) {
            (Some(shown), Some(now)) => shown.is_same(now),
            (shown, now) => shown.is_none() && now.is_none(),
        };
        if !self.open {
            self.link = None;
            return;
        }
        if !self.link.as_ref().is_some_and(is_same) {
            self.link = Some((moment, make_link()));
        }
        let Some((_, link)) = &self.link else { return };
        Window::new("Replay link")
            .open(&mut self.open)
            .anchor(Align2::CENTER_CENTER, [0.0, 0.0])
            .collapsible(false)
            .resizable(false)
            .default_width(460.0)
            .show(context, |ui| {
                ui.label(
                    "It opens this run: the same scene, with everything that was \
                     changed on the way, at the same time, to the bit.",
                );
                let mut text = link.as_str();
                ui.add(
                    TextEdit::multiline(&mut text)
                        .desired_width(f32::INFINITY)
                        .desired_rows(3)
                        .code_editor(),
                );
                ui.horizontal(|ui| {
                    if ui.button("Copy the link").clicked() {
                        context.copy_text(link.clone());
                    }
                    if ui.button("Copy as a command").clicked() {
                        context.copy_text(format!("carom run --link '{link}'"));
                    }
                });
                let hash = view.and_then(|view| view.playback.state_hash);
                if let Some(hash) = hash {
                    ui.monospace(format!("state hash  {hash}"));
                }
            });
    }
}
