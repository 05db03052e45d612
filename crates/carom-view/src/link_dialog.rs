//! The dialog with a link to the present view.

use carom_session::{Link, View};
use egui::{Align2, Context, TextEdit, Window};

use crate::address::Moment;
use crate::layout::show_closable;

/// The dialog with a link to the present view.
#[derive(Default)]
pub struct LinkDialog {
    open: bool,
    /// The link, and the moment it was made for.
    link: Option<(Option<Moment>, String)>,
    /// Time of the last copy, by the clock of the interface \[s\].
    copied: Option<f64>,
}

/// How long the dialog reports a copy \[s\].
const SAID: f64 = 3.0;

/// Returns whether a link works only on this machine.
fn is_local(link: &str) -> bool {
    let host = link.split_once("://").map_or(link, |(_, rest)| rest);
    ["127.0.0.1", "localhost", "[::1]"]
        .iter()
        .any(|local| host.strip_prefix(local).is_some_and(|rest| rest.starts_with([':', '/', '#'])))
}

impl LinkDialog {
    /// Opens or closes the dialog.
    pub fn toggle(&mut self) {
        self.open ^= true;
    }

    /// Closes the dialog.
    pub fn close(&mut self) {
        self.open = false;
    }

    /// Returns whether the dialog is open.
    pub fn is_open(&self) -> bool {
        self.open
    }

    /// Shows the open dialog. `run` is the view and the link to its beginning; `None` for something
    /// that does not change, such as a maze.
    pub fn show(
        &mut self,
        context: &Context,
        run: Option<(&View, &Link)>,
        make_link: impl FnOnce() -> String,
    ) {
        let moment = run.map(|(view, base)| Moment::of(view, base));
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
        const TITLE: &str = "Replay link";
        let window = Window::new(TITLE).anchor(Align2::CENTER_CENTER, [0.0, 0.0]);
        let window = window.resizable(false).default_width(460.0);
        let copied = &mut self.copied;
        show_closable(TITLE, window, context, &mut self.open, |ui| {
            ui.label(match run {
                Some(_) => {
                    "It opens this run: the same scene, with everything that was \
                     changed on the way, at the same time, to the bit."
                }
                None => "It opens this game, with your best result as the one to beat.",
            });
            let mut text = link.as_str();
            ui.add(
                TextEdit::multiline(&mut text)
                    .hint_text("The link")
                    .desired_width(f32::INFINITY)
                    .desired_rows(3)
                    .code_editor(),
            );
            if is_local(link) {
                ui.weak(
                    "This address works on this machine alone. Others can use the command, or a \
                     page that is published.",
                );
            }
            let now = ui.input(|input| input.time);
            ui.horizontal(|ui| {
                let command = || format!("carom run --link '{link}'");
                for (text, copy) in [
                    ("Copy the link", &(|| link.clone()) as &dyn Fn() -> String),
                    ("Copy as a command", &command),
                ] {
                    if ui.button(text).clicked() {
                        context.copy_text(copy());
                        *copied = Some(now);
                    }
                }
                if copied.is_some_and(|at| now - at < SAID) {
                    ui.label("Copied.");
                    ui.ctx().request_repaint_after_secs(SAID as f32);
                }
            });
            let hash = run.and_then(|(view, _)| view.playback.state_hash);
            if let Some(hash) = hash {
                ui.monospace(format!("state hash  {hash}"));
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_addresses_of_this_machine_are_local() {
        for local in ["http://127.0.0.1:8042/#scene=x", "http://localhost/#a", "http://[::1]:1/"] {
            assert!(is_local(local), "{local}");
        }
        for other in ["https://example.org/127.0.0.1/#x", "https://localhost.org/#x"] {
            assert!(!is_local(other), "{other}");
        }
    }
}
