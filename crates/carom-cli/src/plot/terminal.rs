//! Draws figures as text for a terminal: curves in Braille patterns, two by four dots in a character.

use std::fmt::Write;

use carom_session::figures::{Curve, Figure, Form};

use super::axis::Axis;
use super::sheet::Sheet;

/// Characters of a figure across and up, without its marks.
const COLUMNS: usize = 68;
const ROWS: usize = 14;
/// Dots of a character across and up.
const DOTS: [usize; 2] = [2, 4];
/// Width of the marks beside the vertical axis, in characters.
const BESIDE: usize = 10;

/// Pattern without dots, and the bit of each dot of a character, in rows from the top.
const NO_DOTS: u32 = 0x2800;
const BITS: [[u32; 2]; 4] = [[0x01, 0x08], [0x02, 0x10], [0x04, 0x20], [0x40, 0x80]];

/// Ends a colour.
const PLAIN: &str = "\x1b[0m";

/// A character of a figure.
#[derive(Debug, Clone, Copy, Default)]
struct Cell {
    dots: u32,
    /// Red, green and blue of the curve in front.
    color: [u8; 3],
}

/// Returns the figures of a sheet below each other, in colours of a terminal.
pub fn text(sheet: &Sheet) -> String {
    let mut text = format!("{}\n", sheet.heading);
    for figure in &sheet.figures {
        let axes = [Axis::across, Axis::up].map(|axis| axis(figure, sheet.decimal_comma));
        add_figure(figure, &axes, &mut text);
    }
    text
}

fn add_figure(figure: &Figure, axes: &[Axis; 2], text: &mut String) {
    let mut line = |content: &str| text.extend([content.trim_end(), "\n"]);
    line("");
    line(&heading(figure));
    let mut cells = vec![[Cell::default(); COLUMNS]; ROWS];
    figure.curves.iter().for_each(|curve| draw(curve, axes, &mut cells));
    let [across, up] = axes;
    let mut beside = vec![String::new(); ROWS];
    for (value, mark) in up.marks() {
        let row = ((1.0 - up.part(value)) * (ROWS - 1) as f64).round() as usize;
        beside[row.min(ROWS - 1)] = mark;
    }
    for (mark, row) in beside.iter().zip(&cells) {
        line(&format!("{mark:>BESIDE$} │{}", colored(row)));
    }
    line(&format!("{:BESIDE$} └{}", "", "─".repeat(COLUMNS)));
    line(&below(across));
    line(&format!("{:>1$}", figure.axis(), BESIDE + 2 + COLUMNS));
}

/// Returns the title of a figure, and the names of its curves in their colours if there are several.
fn heading(figure: &Figure) -> String {
    let mut text = figure.heading();
    if figure.curves.len() > 1 {
        for curve in &figure.curves {
            // Writing to a string cannot fail.
            let _ = write!(text, "   {}━ {}{PLAIN}", color(curve.hue.rgb()), curve.name);
        }
    }
    text
}

/// Returns the marks below the horizontal axis. One that would touch the mark before is left out.
fn below(across: &Axis) -> String {
    let mut text = " ".repeat(BESIDE + 1);
    for (value, mark) in across.marks() {
        let middle = BESIDE + 2 + (across.part(value) * (COLUMNS - 1) as f64).round() as usize;
        let start = middle.saturating_sub(mark.chars().count() / 2);
        let free = start.checked_sub(text.chars().count()).filter(|free| *free > 0);
        if let Some(free) = free {
            text.extend([" ".repeat(free), mark]);
        }
    }
    text
}

/// Draws a curve: bars from zero, or lines between its points.
fn draw(curve: &Curve, [across, up]: &[Axis; 2], cells: &mut [[Cell; COLUMNS]]) {
    let dots = [COLUMNS * DOTS[0], ROWS * DOTS[1]].map(|dots| (dots - 1) as f64);
    let place = |[x, y]: [f64; 2]| [across.part(x) * dots[0], (1.0 - up.part(y)) * dots[1]];
    let points = curve.points.iter().filter(|point| point[1].is_finite());
    let mut dot = |[x, y]: [f64; 2]| set(cells, [x, y].map(f64::round), curve.hue.rgb());
    match curve.form {
        Form::Bars(_) => points.for_each(|[x, y]| {
            steps(place([*x, 0.0]), place([*x, *y])).for_each(&mut dot);
        }),
        Form::Line => {
            let places: Vec<[f64; 2]> = points.map(|point| place(*point)).collect();
            if let [alone] = places[..] {
                dot(alone);
            }
            places.windows(2).for_each(|ends| steps(ends[0], ends[1]).for_each(&mut dot));
        }
    }
}

/// Returns places on a line, at most a dot apart.
fn steps(from: [f64; 2], to: [f64; 2]) -> impl Iterator<Item = [f64; 2]> {
    let way = [to[0] - from[0], to[1] - from[1]];
    let count = way[0].abs().max(way[1].abs()).ceil().max(1.0) as usize;
    (0..=count).map(move |step| {
        let part = step as f64 / count as f64;
        [from[0] + part * way[0], from[1] + part * way[1]]
    })
}

/// Sets a dot, unless it is outside.
fn set(cells: &mut [[Cell; COLUMNS]], [x, y]: [f64; 2], color: [u8; 3]) {
    if !(x >= 0.0 && y >= 0.0) {
        return;
    }
    let (x, y) = (x as usize, y as usize);
    let row = cells.get_mut(y / DOTS[1]);
    if let Some(cell) = row.and_then(|row| row.get_mut(x / DOTS[0])) {
        cell.dots |= BITS[y % DOTS[1]][x % DOTS[0]];
        cell.color = color;
    }
}

/// Returns a row of characters, each run of one colour between its codes.
fn colored(row: &[Cell]) -> String {
    let mut text = String::new();
    for run in
        row.chunk_by(|one, other| one.dots.min(1) == other.dots.min(1) && one.color == other.color)
    {
        let dots: String = run.iter().filter_map(|cell| character(cell.dots)).collect();
        if run[0].dots == 0 {
            text += &dots;
        } else {
            text.extend([&color(run[0].color), &dots, PLAIN]);
        }
    }
    text
}

/// Returns the Braille pattern of these dots.
fn character(dots: u32) -> Option<char> {
    if dots == 0 { Some(' ') } else { char::from_u32(NO_DOTS + dots) }
}

fn color([red, green, blue]: [u8; 3]) -> String {
    format!("\x1b[38;2;{red};{green};{blue}m")
}
