//! The interface looks like its approved pictures.
//!
//! `UPDATE_SNAPSHOTS=1 cargo test -p carom-view --test interface` redraws them.

use carom_maze::Maze;
use carom_session::Command;
use egui::{Key, Theme};
use egui_kittest::{SnapshotOptions, SnapshotResults};

use crate::desk::{Desk, desk, go_to, press, setup_for_pictures, watching_on};
use crate::maze::{SHORT, playing_on, win};

/// Versions of the software driver round differently at edges of shapes, text and shadows: a
/// thousandth of the pixels may differ. A visible change - another colour, a panel that moved, a
/// ball elsewhere - changes several times as many.
const PIXELS_THAT_MAY_DIFFER: usize = 620;

pub fn compare(desk: &mut Desk, name: &str, results: &mut SnapshotResults) {
    desk.remove_cursor();
    desk.run_steps(3);
    let options = SnapshotOptions::new().max_failed_pixels(PIXELS_THAT_MAY_DIFFER);
    desk.snapshot_options(name, &options);
    results.extend_harness(desk);
}

pub fn set_theme(desk: &mut Desk, theme: Theme) {
    desk.ctx.set_theme(theme);
    desk.run_steps(2);
}

/// A test in each theme.
macro_rules! in_light_and_dark {
    ($($name:ident),*) => {$(
        mod $name {
            #[test]
            fn light() {
                super::$name(egui::Theme::Light);
            }

            #[test]
            fn dark() {
                super::$name(egui::Theme::Dark);
            }
        }
    )*};
}
pub(crate) use in_light_and_dark;

in_light_and_dark!(the_chooser, the_window_with_plots, two_rules, the_maze, the_win_screen);

/// Compares the window with the picture of this name and theme.
fn compare_in(theme: Theme, desk: &mut Desk, name: &str) {
    let mut results = SnapshotResults::new();
    let suffix = if theme == Theme::Dark { "dark" } else { "light" };
    compare(desk, &format!("{name}_{suffix}"), &mut results);
    results.unwrap();
}

fn the_chooser(theme: Theme) {
    let mut desk = desk(setup_for_pictures());
    // The scene behind it is paused at its start.
    desk.state_mut().command(Command::Pause);
    go_to(&mut desk, 0.0);
    set_theme(&mut desk, theme);
    // One thumbnail appears per frame.
    desk.run_steps(24);
    compare_in(theme, &mut desk, "chooser");
}

fn the_window_with_plots(theme: Theme) {
    let mut desk = watching_on(setup_for_pictures(), "simtest1");
    set_theme(&mut desk, theme);
    go_to(&mut desk, 6.0);
    for key in [Key::G, Key::V, Key::K, Key::L] {
        press(&mut desk, key);
    }
    compare_in(theme, &mut desk, "window");
}

fn two_rules(theme: Theme) {
    let mut desk = watching_on(setup_for_pictures(), "tutorial3");
    set_theme(&mut desk, theme);
    for key in [Key::X, Key::I, Key::G] {
        press(&mut desk, key);
    }
    go_to(&mut desk, 3.0);
    compare_in(theme, &mut desk, "two_rules");
}

fn the_maze(theme: Theme) {
    let maze = Maze::course().expect("the course's maze");
    let mut desk = playing_on(setup_for_pictures(), maze);
    set_theme(&mut desk, theme);
    compare_in(theme, &mut desk, "maze");
}

fn the_win_screen(theme: Theme) {
    let maze = Maze::from_text(SHORT, "short").expect("a maze");
    let mut desk = playing_on(setup_for_pictures(), maze);
    set_theme(&mut desk, theme);
    win(&mut desk);
    compare_in(theme, &mut desk, "won");
}
