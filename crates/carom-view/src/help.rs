//! The list of shortcuts.

use egui::{Align2, Context, Grid, RichText, Ui, Window};

use crate::action::{MAZE, MOUSE, SHORTCUTS};
use crate::layout::{scrolled_within, show_closable};

/// Shows all shortcuts and mouse actions; in a maze, first its controls.
pub fn show(context: &Context, open: &mut bool, is_maze: bool) {
    const TITLE: &str = "Keys and mouse";
    let window = Window::new(TITLE).anchor(Align2::CENTER_CENTER, [0.0, 0.0]).resizable(false);
    show_closable(TITLE, window, context, open, |ui| {
        // A small window scrolls the list.
        let room = (ui.ctx().content_rect().height() - 90.0).max(120.0);
        scrolled_within(room).show(ui, |ui| list(ui, is_maze));
    });
}

fn list(ui: &mut Ui, is_maze: bool) {
    Grid::new("keys").num_columns(2).spacing([24.0, 4.0]).striped(true).show(ui, |ui| {
        let of_maze = MAZE.iter().filter(|_| is_maze);
        let steering = of_maze.map(|(how, text)| ((*how).to_owned(), *text));
        let keys = SHORTCUTS.iter().map(|it| (it.keys_text(), it.text));
        let gestures = MOUSE.iter().map(|(gesture, text)| ((*gesture).to_owned(), *text));
        for (how, text) in steering.chain(keys).chain(gestures) {
            ui.label(RichText::new(how).strong());
            ui.label(text);
            ui.end_row();
        }
    });
}
