//! Every built-in scene shows something that moves soon after it opens, in light and dark, and
//! matches approved pictures.

use carom_scene::Library;
use carom_view::Setup;
use egui::Theme;
use egui_kittest::SnapshotResults;

use crate::desk::{desk_of, go_to, setup_for_pictures, start};
use crate::pictures::{compare, set_theme};

/// In points: the smallest size in which a scene can be judged.
const SIZE: [f32; 2] = [440.0, 330.0];

/// Time by which a scene must show movement \[s\].
const SOON: f64 = 1.0;

/// Least part of the pixels that change if something moves in view: a ball with a width of a
/// fiftieth of the picture changes places.
const MOVING: f64 = 5e-4;

/// Height of the transport, which shows the time, below the picture \[px\].
const BELOW: u32 = 90;

mod something_moves_in_view_within_seconds_in_light_and_dark {
    /// Number of tests that share the scenes and run in parallel.
    const PARTS: usize = 6;

    #[test]
    fn first_part() {
        super::moves_in_view(0, PARTS);
    }

    #[test]
    fn second_part() {
        super::moves_in_view(1, PARTS);
    }

    #[test]
    fn third_part() {
        super::moves_in_view(2, PARTS);
    }

    #[test]
    fn fourth_part() {
        super::moves_in_view(3, PARTS);
    }

    #[test]
    fn fifth_part() {
        super::moves_in_view(4, PARTS);
    }

    #[test]
    fn sixth_part() {
        super::moves_in_view(5, PARTS);
    }
}

fn moves_in_view(first: usize, step: usize) {
    let mut results = SnapshotResults::new();
    let entries = Library::new().entries().expect("built-in scenes");
    for entry in entries.iter().skip(first).step_by(step) {
        let mut desk = desk_of(SIZE, Setup { start: start(&entry.name), ..setup_for_pictures() });
        set_theme(&mut desk, Theme::Light);
        // After the start, when the play button no longer covers the picture.
        go_to(&mut desk, 0.2);
        desk.remove_cursor();
        desk.run_steps(3);
        let start = desk.render().expect("a picture");
        go_to(&mut desk, SOON);
        compare(&mut desk, &format!("scenes/{}_light", entry.name), &mut results);
        let then = desk.render().expect("a picture");
        let of_picture = (start.height() - BELOW) as usize * start.width() as usize;
        let pairs = start.pixels().zip(then.pixels()).take(of_picture);
        let changed = pairs.filter(|(before, after)| before != after).count();
        let part = changed as f64 / of_picture as f64;
        assert!(part > MOVING, "{}: {part} of the pixels change", entry.name);
        set_theme(&mut desk, Theme::Dark);
        compare(&mut desk, &format!("scenes/{}_dark", entry.name), &mut results);
    }
    results.unwrap();
}
