//! The list of shortcuts.

use egui::{Align2, Context, Grid, RichText, ScrollArea, Ui, Window};

use crate::action::{MOUSE, SHORTCUTS};

/// Shows every shortcut, and what the mouse does.
pub fn show(context: &Context, open: &mut bool) {
    Window::new("Keys and mouse")
        .open(open)
        .anchor(Align2::CENTER_CENTER, [0.0, 0.0])
        .collapsible(false)
        .resizable(false)
        .show(context, |ui| {
            // A small window shows a part of it.
            let room = ui.ctx().content_rect().height() - 90.0;
            ScrollArea::vertical().max_height(room.max(120.0)).show(ui, list);
        });
}

fn list(ui: &mut Ui) {
    Grid::new("keys").num_columns(2).spacing([24.0, 4.0]).striped(true).show(ui, |ui| {
        let keys = SHORTCUTS.iter().map(|it| (it.keys_text(), it.text));
        let gestures = MOUSE.iter().map(|(gesture, text)| ((*gesture).to_owned(), *text));
        for (how, text) in keys.chain(gestures) {
            ui.label(RichText::new(how).strong());
            ui.label(text);
            ui.end_row();
        }
    });
}
