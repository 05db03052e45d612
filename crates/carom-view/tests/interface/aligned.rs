//! What stands in a row or a column is aligned to a point, by the rectangles of the widgets.

use carom_scene::Library;
use carom_session::Command;
use egui::accesskit::Role;
use egui::epaint::{Shape, TextShape};
use egui::{Key, Rect};
use egui_kittest::kittest::{By, Queryable};

use carom_view::Setup;

use crate::desk::{Desk, PlainHost, desk_of, press, scene, setup, start, watching_at};

/// Largest distance of edges that are aligned, in points.
const ALIGNED: f32 = 1.0;

const WINDOW: [f32; 2] = [1280.0, 800.0];

/// What has a box: labels have the height of their text.
const BOXES: [Role; 4] = [Role::Button, Role::SpinButton, Role::Slider, Role::ComboBox];

/// Returns the widgets of these roles within a rectangle, from above, with their names.
fn widgets(desk: &Desk, roles: &[Role], within: Rect) -> Vec<(Rect, String)> {
    let of_role = |it: &egui_kittest::kittest::AccessKitNode<'_>| roles.contains(&it.role());
    let found = desk.query_all(By::new().predicate(of_role));
    let named = found.map(|it| (it.rect(), format!("{:?}", it)));
    let mut all: Vec<_> = named.filter(|(rect, _)| within.contains_rect(*rect)).collect();
    all.sort_by(|(one, _), (other, _)| one.center().y.total_cmp(&other.center().y));
    all
}

/// Returns the rows of widgets: those whose middles lie within half a height of the first one's.
fn rows(widgets: Vec<(Rect, String)>) -> Vec<Vec<(Rect, String)>> {
    let mut rows: Vec<Vec<(Rect, String)>> = Vec::new();
    for widget in widgets {
        let is_in = |row: &Vec<(Rect, String)>| {
            let first = row[0].0;
            (widget.0.center().y - first.center().y).abs() < 0.5 * first.height()
        };
        match rows.last_mut().filter(|row| is_in(row)) {
            Some(row) => row.push(widget),
            None => rows.push(vec![widget]),
        }
    }
    rows
}

fn spread(places: impl Iterator<Item = f32> + Clone) -> f32 {
    places.clone().fold(f32::MIN, f32::max) - places.fold(f32::MAX, f32::min)
}

/// Opens the settings of a scene, with a picked ball where there is one.
fn settings(name: &str) -> Option<Desk> {
    let mut desk = watching_at(WINDOW, name);
    desk.state().watching()?;
    if let Some(ball) = scene(&desk).view().spheres.ids.first().copied() {
        desk.state_mut().command(Command::Pick(Some(ball)));
    }
    desk.run_steps(3);
    Some(desk)
}

#[test]
fn settings_of_every_scene_stand_in_rows_and_columns() {
    for entry in Library::new().entries().expect("built-in scenes") {
        let Some(desk) = settings(&entry.name) else { continue };
        let picture = desk.get_by_role_and_label(Role::Image, "Scene").rect();
        let panel = Rect::from_min_max(picture.right_top(), WINDOW.into());
        let panel = panel.with_max_y(picture.bottom());
        let rows = rows(widgets(&desk, &BOXES, panel));
        assert!(rows.len() > 4, "{}: {} rows", entry.name, rows.len());
        for row in &rows {
            let off = spread(row.iter().map(|(rect, _)| rect.center().y));
            assert!(off <= ALIGNED, "{}: {off} in {row:?}", entry.name);
            let right = row.iter().map(|(rect, _)| rect.right()).fold(0.0, f32::max);
            assert!(right <= WINDOW[0], "{}: {row:?}", entry.name);
        }
        // Numbers alone in their rows, and the first of three, each stand below each other.
        let numbers = self::rows(widgets(&desk, &[Role::SpinButton], panel));
        for count in [1, 3] {
            let of_count = numbers.iter().filter(|row| row.len() == count);
            let firsts = of_count.map(|row| {
                let left = |it: &&(Rect, String)| it.0.left();
                row.iter().min_by(|a, b| left(a).total_cmp(&left(b))).expect("a number")
            });
            let mut columns: Vec<f32> = Vec::new();
            for (rect, _) in firsts {
                if !columns.iter().any(|it| (it - rect.left()).abs() <= ALIGNED) {
                    columns.push(rect.left());
                }
            }
            // A tick stands before an optional number, and a slider before its own.
            assert!(columns.len() <= 3, "{}: {count} at {columns:?}", entry.name);
        }
    }
}

#[test]
fn the_bars_have_their_controls_in_a_row_in_windows_of_four_sizes() {
    for size in [WINDOW, [800.0, 600.0], [390.0, 844.0], [844.0, 390.0]] {
        let desk = watching_at(size, "cradle");
        let picture = desk.get_by_role_and_label(Role::Image, "Scene").rect();
        let window = Rect::from_min_size(egui::Pos2::ZERO, size.into());
        let above = rows(widgets(&desk, &BOXES, window.with_max_y(picture.top())));
        assert_eq!(above.len(), 1, "{size:?}: {above:?}");
        let below = rows(widgets(&desk, &BOXES, window.with_min_y(picture.bottom())));
        // A window as narrow as that of a telephone has three lines.
        assert_eq!(below.len(), if size[0] < 640.0 { 3 } else { 1 }, "{size:?}: {below:?}");
        for row in above.iter().chain(&below) {
            let off = spread(row.iter().map(|(rect, _)| rect.center().y));
            assert!(off <= ALIGNED, "{size:?}: {off} in {row:?}");
        }
        // Nothing lies over its neighbour.
        for row in above.iter().chain(&below) {
            let mut rects: Vec<Rect> = row.iter().map(|(rect, _)| *rect).collect();
            rects.sort_by(|one, other| one.left().total_cmp(&other.left()));
            for pair in rects.windows(2) {
                // A slider and its number share an edge.
                assert!(pair[1].left() >= pair[0].right() - ALIGNED, "{size:?}: {pair:?}");
            }
        }
    }
}

#[test]
fn the_time_line_is_long_and_the_pace_beside_it_covers_nothing() {
    let by_fingers = |has_coarse_pointer| {
        let host = Box::new(PlainHost { has_coarse_pointer, ..PlainHost::default() });
        Setup { host, start: start("cradle"), ..setup() }
    };
    for (size, is_touched) in
        [(WINDOW, false), ([800.0, 600.0], false), ([844.0, 390.0], false), ([844.0, 390.0], true)]
    {
        let mut desk = desk_of(size, by_fingers(is_touched));
        // The message of a pace that is not reached may be there or not.
        desk.state_mut().command(Command::Speed(10.0));
        press(&mut desk, Key::P);
        desk.run_steps(5);
        let line = desk.get_by_label("Time line").rect();
        assert!(line.width() >= 100.0, "{size:?}, {is_touched}: {line}");
        let clock = desk.get_by_label_contains("t = ").rect();
        assert!(clock.right() <= line.left(), "{size:?}, {is_touched}: {clock} {line}");
        assert!(line.right() <= size[0], "{size:?}, {is_touched}: {line}");
    }
}

fn texts(shape: &Shape, found: &mut Vec<TextShape>) {
    match shape {
        Shape::Text(text) => found.push(text.clone()),
        Shape::Vec(shapes) => shapes.iter().for_each(|shape| texts(shape, found)),
        _ => {}
    }
}

#[test]
fn the_text_of_the_large_button_is_in_its_middle() {
    for size in [WINDOW, [800.0, 600.0], [390.0, 844.0], [844.0, 390.0]] {
        let mut desk = watching_at(size, "cradle");
        for label in ["Play", "Pause"] {
            let button = desk.get_by_label(label).rect();
            let mut found = Vec::new();
            desk.output().shapes.iter().for_each(|it| texts(&it.shape, &mut found));
            let is_its = |it: &&TextShape| it.galley.text().ends_with(label);
            let text = found.iter().find(is_its).expect("the text of the button");
            let middle = text.galley.rect.translate(text.pos.to_vec2()).center();
            let off = (middle - button.center()).abs();
            assert!(off.max_elem() <= ALIGNED, "{size:?}, {label}: {off}");
            press(&mut desk, Key::P);
        }
    }
}
