//! Entries of the menus in the top bar.

use egui::{Button, Role, Ui, WidgetInfo};

use crate::action::Action;

/// Smallest width of a menu, in points.
const WIDTH: f32 = 230.0;

/// An entry of a menu.
#[derive(Debug, Clone, Copy)]
pub struct Entry {
    pub text: &'static str,
    pub action: Action,
    /// Whether it is switched on; `None` for an entry that is no switch.
    pub is_on: Option<bool>,
}

impl Entry {
    /// Returns an entry that does something once.
    pub const fn once(text: &'static str, action: Action) -> Self {
        Self { text, action, is_on: None }
    }

    /// Returns an entry that is on or off.
    pub const fn switch(text: &'static str, action: Action, is_on: bool) -> Self {
        Self { text, action, is_on: Some(is_on) }
    }
}

/// Shows entries with their keys. Returns the actions of those that were pressed.
pub fn show(ui: &mut Ui, entries: &[Entry]) -> Vec<Action> {
    ui.set_min_width(WIDTH);
    let pressed = entries.iter().filter(|entry| {
        let is_on = entry.is_on.unwrap_or(false);
        let button = Button::selectable(is_on, entry.text).shortcut_text(entry.action.keys());
        let response = ui.add(button).on_hover_text(entry.action.hint());
        response.widget_info(|| match entry.is_on {
            Some(is_on) => WidgetInfo::selected(Role::Button, true, is_on, entry.text),
            None => WidgetInfo::labeled(Role::Button, true, entry.text),
        });
        response.clicked()
    });
    pressed.map(|entry| entry.action).collect()
}
