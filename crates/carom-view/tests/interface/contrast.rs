//! Every text of the interface has enough contrast to its background, measured in pictures.

use std::collections::HashMap;

use carom_maze::Maze;
use carom_render::Picture;
use carom_view::{Setup, Start};
use egui::epaint::{Shape, TextShape};
use egui::{Color32, Key, Rect, Theme, Vec2};
use egui_kittest::kittest::Queryable;

use crate::desk::{Desk, choosing, desk, desk_of, go_to, press, setup_for_pixels, watching_on};
use crate::maze::{SHORT, win};
use crate::pictures::{in_light_and_dark, set_theme};

/// Least contrast of text, of large text (24 pixels and more) and of graphics: Web Content
/// Accessibility Guidelines 2.2, 1.4.3 and 1.4.11.
const TEXT: f64 = 4.5;
const LARGE_TEXT: f64 = 3.0;
const LARGE: f32 = 24.0;

/// Returns the relative luminance of a colour, as the guidelines define it.
fn luminance(color: [u8; 3]) -> f64 {
    let [red, green, blue] = color.map(|part| {
        let part = f64::from(part) / 255.0;
        if part <= 0.04045 { part / 12.92 } else { ((part + 0.055) / 1.055).powf(2.4) }
    });
    0.2126 * red + 0.7152 * green + 0.0722 * blue
}

fn contrast(one: [u8; 3], other: [u8; 3]) -> f64 {
    let [one, other] = [one, other].map(|color| luminance(color) + 0.05);
    (one / other).max(other / one)
}

/// Returns the most frequent colour in a part of a picture.
fn background(picture: &Picture, part: Rect, pixels_per_point: f32) -> Option<[u8; 3]> {
    let [width, height] = [picture.width, picture.height].map(|edge| edge as f32);
    let part = part * pixels_per_point;
    let part = part.intersect(Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(width, height)));
    let mut counts: HashMap<[u8; 3], usize> = HashMap::new();
    for y in part.top() as u32..part.bottom() as u32 {
        for x in part.left() as u32..part.right() as u32 {
            let first = 4 * (y * picture.width + x) as usize;
            let color = std::array::from_fn(|i| picture.pixels[first + i]);
            *counts.entry(color).or_default() += 1;
        }
    }
    // A part without a dominant colour shows a picture, which has no single background.
    let all: usize = counts.values().sum();
    let (color, count) = counts.into_iter().max_by_key(|(color, count)| (*count, *color))?;
    (5 * count > 2 * all).then_some(color)
}

/// Blends a colour over another as the interface does.
fn over(color: Color32, below: [u8; 3]) -> [u8; 3] {
    let [red, green, blue, alpha] = color.to_array();
    let rest = 255 - u32::from(alpha);
    let part = |upper: u8, lower: u8| (u32::from(upper) + rest * u32::from(lower) / 255).min(255);
    std::array::from_fn(|i| part([red, green, blue][i], below[i]) as u8)
}

fn texts(shape: &Shape, found: &mut Vec<TextShape>) {
    match shape {
        Shape::Text(text) => found.push(text.clone()),
        Shape::Vec(shapes) => shapes.iter().for_each(|shape| texts(shape, found)),
        _ => {}
    }
}

/// Returns the texts with too little contrast, and the number of texts measured.
fn measured(desk: &mut Desk, screen: &str) -> (Vec<String>, usize) {
    desk.remove_cursor();
    desk.run_steps(3);
    let disabled: Vec<Rect> = {
        desk.query_all_by(|node| node.is_disabled()).map(|node| node.rect().expand(1.0)).collect()
    };
    let picture = desk.render().expect("a picture");
    let [width, height] = [picture.width(), picture.height()];
    let picture = Picture { width, height, pixels: picture.into_raw() };
    let pixels_per_point = desk.ctx.pixels_per_point();
    let mut faint = Vec::new();
    let mut count = 0;
    let shapes = &desk.output().shapes;
    // Texts behind the shade of a dialog are inactive.
    let window = desk.ctx.content_rect();
    let dims = |shape: &Shape| match shape {
        Shape::Rect(rect) => rect.rect.contains_rect(window) && (1..255).contains(&rect.fill.a()),
        _ => false,
    };
    let first = shapes.iter().rposition(|clipped| dims(&clipped.shape)).unwrap_or(0);
    for clipped in &shapes[first..] {
        let mut found = Vec::new();
        texts(&clipped.shape, &mut found);
        for text in found {
            let part = text.visual_bounding_rect().intersect(clipped.clip_rect);
            // Inactive texts may be faint.
            let is_disabled = disabled.iter().any(|rect| rect.contains(part.center()));
            if is_disabled || !part.is_positive() || text.galley.text().trim().is_empty() {
                continue;
            }
            // A letter like I covers more of its own rectangle than the background does.
            let around = part.expand2(Vec2::new(2.0, 0.0)).intersect(clipped.clip_rect);
            let Some(below) = background(&picture, around, pixels_per_point) else { continue };
            for section in &text.galley.job.sections {
                let own = section.format.color;
                let own = if own == Color32::PLACEHOLDER { text.fallback_color } else { own };
                let color = text.override_text_color.unwrap_or(own);
                let color = color.gamma_multiply(text.opacity_factor);
                let plain = section.format.background;
                let below = if plain.a() == 255 { over(plain, below) } else { below };
                let size = section.format.font_id.size * pixels_per_point;
                let start = section.byte_range.start.0;
                let is_graphic = text.galley.text()[start..].starts_with('■');
                let needed = if size >= LARGE || is_graphic { LARGE_TEXT } else { TEXT };
                let seen = contrast(over(color, below), below);
                count += 1;
                if seen < needed {
                    let text: String = text.galley.text().chars().take(40).collect();
                    faint.push(format!("{screen}: {text:?} {seen:.1}, {color:?} on {below:?}"));
                }
            }
        }
    }
    (faint, count)
}

in_light_and_dark!(
    every_text_has_a_contrast_of_four_and_a_half,
    every_text_has_a_contrast_of_four_and_a_half_in_mazes
);

/// In points; small, because drawing the maze takes time and only its texts matter.
const MAZE: [f32; 2] = [640.0, 420.0];

fn assert_readable(screens: Vec<(Desk, &str)>, theme: Theme, least: usize) {
    let mut faint = Vec::new();
    let mut count = 0;
    for (mut desk, screen) in screens {
        set_theme(&mut desk, theme);
        let (more, measured) = measured(&mut desk, &format!("{screen}, {theme:?}"));
        faint.extend(more);
        count += measured;
    }
    assert!(count > least, "{count} texts measured");
    assert!(faint.is_empty(), "{} of {count} are faint:\n{}", faint.len(), faint.join("\n"));
}

fn every_text_has_a_contrast_of_four_and_a_half(theme: Theme) {
    let first = desk(setup_for_pixels());
    let chooser = choosing(setup_for_pixels());
    let mut plots = watching_on(setup_for_pixels(), "simtest1");
    go_to(&mut plots, 3.0);
    for key in [Key::G, Key::V, Key::K, Key::L] {
        press(&mut plots, key);
    }
    let mut help = watching_on(setup_for_pixels(), "tutorial1");
    press(&mut help, Key::F1);
    let mut link = watching_on(setup_for_pixels(), "cradle");
    press(&mut link, Key::U);
    let mut refused = watching_on(setup_for_pixels(), "cradle");
    refused.state_mut().refuse_link("no such link");
    let screens = vec![
        (first, "first visit"),
        (chooser, "chooser"),
        (plots, "plots and impacts"),
        (help, "help"),
        (link, "link"),
        (refused, "notice"),
    ];
    assert_readable(screens, theme, 200);
}

fn every_text_has_a_contrast_of_four_and_a_half_in_mazes(theme: Theme) {
    let playing = |maze| {
        let start = Some(Start::Maze(Box::new(maze)));
        desk_of(MAZE, Setup { start, ..setup_for_pixels() })
    };
    let maze = playing(Maze::course().expect("the course's maze"));
    let mut won = playing(Maze::from_text(SHORT, "short").expect("a maze"));
    win(&mut won);
    assert_readable(vec![(maze, "maze"), (won, "won")], theme, 20);
}
