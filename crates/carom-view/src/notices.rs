//! Messages to the user: actions that succeeded, and errors.

use egui::{Align2, Area, Color32, Frame, Id, RichText, Ui};

/// How long a message without an error is shown \[s\].
const SHOWN: f64 = 4.0;

/// Messages, oldest first.
#[derive(Debug, Default)]
pub struct Notices {
    list: Vec<Notice>,
}

#[derive(Debug)]
struct Notice {
    text: String,
    is_error: bool,
    /// When it was first shown, by the clock of the interface \[s\].
    since: Option<f64>,
}

impl Notices {
    /// Adds the message of an action that succeeded.
    pub fn tell(&mut self, text: impl Into<String>) {
        self.add(text.into(), false);
    }

    /// Adds an error, which is shown until the user closes it.
    pub fn complain(&mut self, text: impl ToString) {
        self.add(text.to_string(), true);
    }

    fn add(&mut self, text: String, is_error: bool) {
        self.list.retain(|notice| notice.text != text);
        self.list.push(Notice { text, is_error, since: None });
    }

    /// Returns whether an error is still open.
    pub fn any_error(&self) -> bool {
        self.list.iter().any(|notice| notice.is_error)
    }

    /// Returns the open messages, oldest first.
    pub fn texts(&self) -> impl Iterator<Item = &str> {
        self.list.iter().map(|notice| notice.text.as_str())
    }

    /// Removes all messages.
    pub fn clear(&mut self) {
        self.list.clear();
    }

    /// Shows the messages at the upper edge.
    pub fn show(&mut self, ui: &mut Ui) {
        let now = ui.input(|input| input.time);
        self.list.retain_mut(|notice| {
            let since = *notice.since.get_or_insert(now);
            notice.is_error || now - since < SHOWN
        });
        if self.list.is_empty() {
            return;
        }
        if self.list.iter().any(|notice| !notice.is_error) {
            ui.ctx().request_repaint_after_secs(0.5);
        }
        let mut closed = None;
        Area::new(Id::unique("notices")).anchor(Align2::CENTER_TOP, [0.0, 44.0]).show(
            ui.ctx(),
            |ui| {
                for (i, notice) in self.list.iter().enumerate() {
                    let fill = if notice.is_error {
                        Color32::from_rgb(158, 42, 43)
                    } else {
                        Color32::from_rgb(38, 70, 83)
                    };
                    Frame::popup(ui.style()).fill(fill).show(ui, |ui| {
                        ui.set_max_width(640.0);
                        ui.horizontal_wrapped(|ui| {
                            ui.label(RichText::new(&notice.text).color(Color32::WHITE));
                            if notice.is_error && ui.small_button("Close").clicked() {
                                closed = Some(i);
                            }
                        });
                    });
                }
            },
        );
        if let Some(i) = closed {
            self.list.remove(i);
        }
    }
}
