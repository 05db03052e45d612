//! The list of shortcuts.

use egui::{Align2, Context, Grid, KeyboardShortcut, RichText, Window};

use crate::action::{MOUSE, SHORTCUTS};

/// Shows every shortcut, and what the mouse does.
pub fn show(context: &Context, open: &mut bool) {
    Window::new("Keys and mouse")
        .open(open)
        .anchor(Align2::CENTER_CENTER, [0.0, 0.0])
        .collapsible(false)
        .resizable(false)
        .show(context, |ui| {
            Grid::new("keys").num_columns(2).spacing([24.0, 4.0]).striped(true).show(ui, |ui| {
                for shortcut in SHORTCUTS {
                    let name = |key: &KeyboardShortcut| {
                        let control = if key.modifiers.command { "Ctrl + " } else { "" };
                        format!("{control}{}", key.logical_key.symbol_or_name())
                    };
                    let keys: Vec<String> = shortcut.keys.iter().map(name).collect();
                    ui.label(RichText::new(keys.join("  or  ")).strong());
                    ui.label(shortcut.text);
                    ui.end_row();
                }
                for (gesture, text) in MOUSE {
                    ui.label(RichText::new(*gesture).strong());
                    ui.label(*text);
                    ui.end_row();
                }
            });
        });
}
