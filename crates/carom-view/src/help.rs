//! The list of shortcuts.

use egui::{Align2, Context, Grid, RichText, Ui, Window};

use crate::action::{GameControls, Group, MOUSE, SHORTCUTS};
use crate::layout::{scrolled_within, show_closable};

/// Width of the window from which on the list has two columns, in points.
const TWO_COLUMNS: f32 = 900.0;

/// Shows all shortcuts and mouse actions in groups; in a game, first its controls.
pub fn show(context: &Context, open: &mut bool, game: Option<&GameControls>) {
    const TITLE: &str = "Keys and mouse";
    let window = Window::new(TITLE).anchor(Align2::CENTER_CENTER, [0.0, 0.0]).resizable(false);
    show_closable(TITLE, window, context, open, |ui| {
        // A small window scrolls the list.
        let size = ui.ctx().content_rect().size();
        let room = (size.y - 90.0).max(120.0);
        scrolled_within(room).show(ui, |ui| {
            let groups = groups(game);
            if size.x < TWO_COLUMNS {
                groups.iter().for_each(|group| list(ui, group));
                return;
            }
            // What the hand does is the last group, as long as half of the others.
            let half = groups.len() / 2;
            ui.horizontal_top(|ui| {
                for part in [&groups[..half], &groups[half..]] {
                    ui.vertical(|ui| part.iter().for_each(|group| list(ui, group)));
                    ui.add_space(12.0);
                }
            });
        });
    });
}

/// A heading, and the controls below it with their texts.
type Listed = (&'static str, Vec<(String, &'static str)>);

/// Returns the groups of the help.
fn groups(game: Option<&GameControls>) -> Vec<Listed> {
    let plain = |all: &[(&str, &'static str)]| -> Vec<_> {
        all.iter().map(|(how, text)| ((*how).to_owned(), *text)).collect()
    };
    let of_keys = |group: Group| {
        let own = SHORTCUTS.iter().filter(|it| it.group == group);
        (group.title(), own.map(|it| (it.keys_text(), it.text)).collect())
    };
    let game = game.map(|(title, controls)| (*title, plain(controls)));
    let mouse = ("Mouse and fingers", plain(MOUSE));
    game.into_iter().chain(Group::ALL.map(of_keys)).chain([mouse]).collect()
}

fn list(ui: &mut Ui, (title, rows): &Listed) {
    ui.add_space(6.0);
    ui.label(RichText::new(*title).strong().size(15.0));
    Grid::new(*title).num_columns(2).spacing([16.0, 3.0]).min_col_width(120.0).show(ui, |ui| {
        for (how, text) in rows {
            ui.label(RichText::new(how).strong());
            ui.label(*text);
            ui.end_row();
        }
    });
}
