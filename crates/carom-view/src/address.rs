//! Links to what is shown: told to the host, and shown for people to copy.

use std::sync::Arc;

use carom_scene::scene::Scene;
use carom_session::{Link, LinkSource, View};
use egui::{Align2, Context, TextEdit, Window};

use crate::host::Host;

/// Least time between two links that are told to the host \[s\].
const INTERVAL: f64 = 1.0;

/// A scene file of more bytes is not told to the host as it goes on: no address bar takes it.
const LARGEST_FILE: usize = 100_000;

/// Which link is shown.
#[derive(Default)]
pub struct Address {
    told: Option<Moment>,
    /// When it was told, by the clock of the interface \[s\].
    told_at: f64,
}

/// All that a link depends on.
#[derive(Debug, Clone)]
struct Moment {
    scene: Arc<Scene>,
    frame: u64,
    changes: usize,
}

impl Moment {
    fn of(view: &View) -> Self {
        Self { scene: view.scene.clone(), frame: view.frame, changes: view.changes.len() }
    }

    fn is_same(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.scene, &other.scene)
            && (self.frame, self.changes) == (other.frame, other.changes)
    }
}

impl Address {
    /// Tells the host a link to what is shown, if it has changed and the last was not told just now.
    pub fn tell(&mut self, view: &View, base: &Link, host: &mut dyn Host, context: &Context) {
        let is_large =
            matches!(base.source(), LinkSource::File { text, .. } if text.len() > LARGEST_FILE);
        if !host.shows_links() || is_large || view.seeking.is_some() {
            return;
        }
        let moment = Moment::of(view);
        if self.told.as_ref().is_some_and(|told| told.is_same(&moment)) {
            return;
        }
        let now = context.input(|input| input.time);
        let is_another_scene =
            self.told.as_ref().is_none_or(|told| !Arc::ptr_eq(&told.scene, &moment.scene));
        if !is_another_scene && now - self.told_at < INTERVAL {
            context.request_repaint_after_secs(INTERVAL as f32);
            return;
        }
        host.show_link(&base.at(view));
        self.told = Some(moment);
        self.told_at = now;
    }
}

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
                    "Whoever opens it sees this run: the same scene, with everything that was \
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
