//! The interface looks like its approved pictures.
//!
//! `UPDATE_SNAPSHOTS=1 cargo test -p carom-view --test interface` redraws them.

use carom_maze::Maze;
use carom_session::Command;
use carom_view::{Action, Setup, Start};
use egui::{Key, Theme, Vec2};
use egui_kittest::{SnapshotOptions, SnapshotResults};

use crate::desk::{Desk, SIZE, desk_for_picture, go_to, press, scene, setup_for_pictures, start};
use crate::maze::{SHORT, win};
use crate::{billiards, pinball};

/// Versions of the software driver round differently at edges of shapes, text and shadows: a
/// thousandth of the pixels may differ. A visible change - another colour, a panel that moved, a
/// ball elsewhere - changes several times as many.
const PIXELS_THAT_MAY_DIFFER: usize = 620;

/// Pixels per point of pictures of a window, and of several windows of one kind.
const COARSE: f32 = 0.6;
const COARSEST: f32 = 0.4;

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

in_light_and_dark!(
    the_chooser,
    the_window_with_plots,
    windows_of_four_sizes,
    two_rules,
    the_maze,
    the_win_screen,
    pinball_in_two_sizes,
    the_end_of_pinball,
    nine_ball_in_two_sizes,
    the_end_of_a_rack
);

/// Compares the window with the picture of this name and theme.
fn compare_in(theme: Theme, desk: &mut Desk, name: &str) {
    let mut results = SnapshotResults::new();
    compare(desk, &format!("{name}_{}", name_of(theme)), &mut results);
    results.unwrap();
}

fn name_of(theme: Theme) -> &'static str {
    if theme == Theme::Dark { "dark" } else { "light" }
}

/// Opens a built-in scene.
pub fn watched(size: [f32; 2], name: &str) -> Desk {
    desk_for_picture(size, COARSE, Setup { start: start(name), ..setup_for_pictures() })
}

fn played(maze: Maze) -> Desk {
    let start = Some(Start::Maze(Box::new(maze)));
    desk_for_picture(SIZE, COARSE, Setup { start, ..setup_for_pictures() })
}

fn the_chooser(theme: Theme) {
    let mut desk = desk_for_picture(SIZE, COARSE, setup_for_pictures());
    set_theme(&mut desk, theme);
    press(&mut desk, Key::Enter);
    // Until the thumbnails are drawn.
    desk.run_steps(40);
    compare_in(theme, &mut desk, "chooser");
}

fn the_window_with_plots(theme: Theme) {
    let mut desk = watched(SIZE, "simtest1");
    set_theme(&mut desk, theme);
    go_to(&mut desk, 6.0);
    for key in [Key::G, Key::V, Key::K, Key::L] {
        press(&mut desk, key);
    }
    compare_in(theme, &mut desk, "window");
}

#[test]
fn a_nudge() {
    let mut desk = watched(SIZE, "billiards");
    set_theme(&mut desk, Theme::Light);
    press(&mut desk, Key::N);
    go_to(&mut desk, 4.0);
    compare_in(Theme::Light, &mut desk, "nudge");
}

#[test]
fn contact_forces_of_a_heap_are_chains() {
    let setup = Setup { start: start("pour"), ..setup_for_pictures() };
    let mut desk = desk_for_picture([800.0, 600.0], COARSE, setup);
    set_theme(&mut desk, Theme::Light);
    go_to(&mut desk, 4.0);
    press(&mut desk, Key::C);
    compare_in(Theme::Light, &mut desk, "contact_forces");
}

/// A cradle with a picked ball; in small windows with the sheet of the inspector.
fn windows_of_four_sizes(theme: Theme) {
    let mut results = SnapshotResults::new();
    for [width, height] in [[1280.0, 800.0], [800.0, 600.0], [390.0, 844.0], [844.0, 390.0]] {
        let setup = Setup { start: start("cradle"), ..setup_for_pictures() };
        let mut desk = desk_for_picture([width, height], COARSEST, setup);
        set_theme(&mut desk, theme);
        go_to(&mut desk, 1.0);
        let ball = scene(&desk).view().spheres.ids[3];
        desk.state_mut().command(Command::Pick(Some(ball)));
        if width < 900.0 {
            press(&mut desk, Key::I);
        }
        compare(&mut desk, &format!("cradle_{width}_{}", name_of(theme)), &mut results);
    }
    results.unwrap();
}

fn two_rules(theme: Theme) {
    let mut desk = watched(SIZE, "tutorial3");
    set_theme(&mut desk, theme);
    for key in [Key::X, Key::I, Key::G] {
        press(&mut desk, key);
    }
    go_to(&mut desk, 3.0);
    compare_in(theme, &mut desk, "two_rules");
}

fn the_maze(theme: Theme) {
    let maze = Maze::course().expect("the course's maze");
    let mut desk = played(maze);
    set_theme(&mut desk, theme);
    compare_in(theme, &mut desk, "maze");
}

/// A ball in play, and a flipper that is raised.
fn pinball_in_two_sizes(theme: Theme) {
    let mut results = SnapshotResults::new();
    for [width, height] in [[1280.0, 800.0], [390.0, 844.0]] {
        let setup = Setup { start: pinball::start(), ..setup_for_pictures() };
        let mut desk = desk_for_picture([width, height], COARSE, setup);
        set_theme(&mut desk, theme);
        pinball::shoot(&mut desk);
        desk.key_down(Key::ArrowLeft);
        desk.run_steps(4);
        desk.state_mut().act(Action::PlayOrPause);
        compare(&mut desk, &format!("pinball_{width}_{}", name_of(theme)), &mut results);
    }
    results.unwrap();
}

fn the_end_of_pinball(theme: Theme) {
    let setup = Setup { start: pinball::start(), ..setup_for_pictures() };
    let mut desk = desk_for_picture(SIZE, COARSE, setup);
    set_theme(&mut desk, theme);
    pinball::lose(&mut desk);
    compare_in(theme, &mut desk, "pinball_over");
}

/// A break that is aimed, with its path.
fn nine_ball_in_two_sizes(theme: Theme) {
    let mut results = SnapshotResults::new();
    for [width, height] in [[1280.0, 800.0], [390.0, 844.0]] {
        let setup = Setup { start: billiards::start(), ..setup_for_pictures() };
        let mut desk = desk_for_picture([width, height], COARSE, setup);
        set_theme(&mut desk, theme);
        desk.run_steps(2);
        billiards::drag(&mut desk, Vec2::new(30.0, -90.0));
        compare(&mut desk, &format!("nine_ball_{width}_{}", name_of(theme)), &mut results);
    }
    results.unwrap();
}

fn the_end_of_a_rack(theme: Theme) {
    let setup = Setup { start: billiards::start_of_combination(), ..setup_for_pictures() };
    let mut desk = desk_for_picture(SIZE, COARSE, setup);
    set_theme(&mut desk, theme);
    desk.run_steps(2);
    billiards::win(&mut desk);
    compare_in(theme, &mut desk, "nine_ball_over");
}

fn the_win_screen(theme: Theme) {
    let maze = Maze::from_text(SHORT, "short").expect("a maze");
    let mut desk = played(maze);
    set_theme(&mut desk, theme);
    win(&mut desk);
    compare_in(theme, &mut desk, "won");
}
