//! What the interface looks like, against pictures that were looked at.
//!
//! `UPDATE_SNAPSHOTS=1 cargo test -p carom-view --test interface` draws them anew.

use carom_maze::Maze;
use carom_session::Command;
use egui::{Key, Theme};
use egui_kittest::{SnapshotOptions, SnapshotResults};

use crate::desk::{Desk, desk, go_to, press, setup, watching};
use crate::maze::{SHORT, playing, win};

/// Versions of the software driver round differently at edges of shapes, text and shadows: a part
/// in a thousand of the pixels may differ. What a user would notice - another colour, a panel that
/// moved, a ball elsewhere - changes several times as many.
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

#[test]
fn the_chooser() {
    let mut results = SnapshotResults::new();
    for (theme, name) in [(Theme::Light, "chooser_light"), (Theme::Dark, "chooser_dark")] {
        let mut desk = desk(setup());
        // The scene behind it stands still, whatever the clock says.
        desk.state_mut().command(Command::Pause);
        go_to(&mut desk, 0.0);
        set_theme(&mut desk, theme);
        // Thumbnails come one by one.
        desk.run_steps(24);
        compare(&mut desk, name, &mut results);
    }
    results.unwrap();
}

#[test]
fn the_window_with_plots() {
    let mut results = SnapshotResults::new();
    for (theme, name) in [(Theme::Light, "window_light"), (Theme::Dark, "window_dark")] {
        let mut desk = watching("simtest1");
        set_theme(&mut desk, theme);
        go_to(&mut desk, 6.0);
        for key in [Key::G, Key::V, Key::K, Key::L] {
            press(&mut desk, key);
        }
        compare(&mut desk, name, &mut results);
    }
    results.unwrap();
}

#[test]
fn two_rules() {
    let mut results = SnapshotResults::new();
    for (theme, name) in [(Theme::Light, "two_rules_light"), (Theme::Dark, "two_rules_dark")] {
        let mut desk = watching("tutorial3");
        set_theme(&mut desk, theme);
        for key in [Key::X, Key::I, Key::G] {
            press(&mut desk, key);
        }
        go_to(&mut desk, 3.0);
        compare(&mut desk, name, &mut results);
    }
    results.unwrap();
}

#[test]
fn the_maze() {
    let mut results = SnapshotResults::new();
    for (theme, name) in [(Theme::Light, "maze_light"), (Theme::Dark, "maze_dark")] {
        let mut desk = playing(Maze::course().expect("the course's maze"));
        set_theme(&mut desk, theme);
        compare(&mut desk, name, &mut results);
    }
    results.unwrap();
}

#[test]
fn the_win_screen() {
    let mut results = SnapshotResults::new();
    for (theme, name) in [(Theme::Light, "won_light"), (Theme::Dark, "won_dark")] {
        let mut desk = playing(Maze::from_text(SHORT, "short").expect("a maze"));
        set_theme(&mut desk, theme);
        win(&mut desk);
        compare(&mut desk, name, &mut results);
    }
    results.unwrap();
}
