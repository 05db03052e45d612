//! Text on a picture: the name of the scene, and the time.

use ab_glyph::{Font, FontArc, Glyph, PxScale, ScaleFont, point};

use crate::fonts::{KnownFont, font_of};
use crate::picture::Picture;

/// Height of the text as a part of the picture's height.
const TEXT_PART: f32 = 1.0 / 28.0;
/// Height of a caption as a part of the picture: large enough to be read at a glance.
const CAPTION_PART: f32 = 1.0 / 9.0;
/// Text smaller than this cannot be read \[px\].
const SMALLEST: f32 = 12.0;

/// Characters after which a text is cut before its width is measured; a longer one fits in no
/// picture.
const LONGEST: usize = 1000;

// Sizes of the backing, in heights of the text.
const PADDING_X: f32 = 0.55;
const PADDING_Y: f32 = 0.25;
const CORNER: f32 = 0.35;
const MARGIN: f32 = 0.55;

/// Opacity at which white text on white has a contrast of 4.5 : 1 (WCAG 2, level AA).
const BACKING_OPACITY: f32 = 0.62;
/// Width over which the backing's edge fades \[px\].
const SOFTNESS: f32 = 1.5;

/// Writes a line of text onto the lower left of a picture, for example `simtest1  t = 3.200 s`:
/// white on a dark, translucent backing, readable on anything.
///
/// The size follows the picture's height. Text too wide for the picture becomes smaller; at the
/// smallest size it is cut and ends in an ellipsis. If that does not fit either, nothing is
/// written. Characters that no font draws are left out; see [`missing_characters`].
pub fn stamp(picture: &mut Picture, text: &str) {
    write(picture, text, TEXT_PART, Place::LowerLeft);
}

/// Writes large text such as `You win!` into the middle of a picture, in the style of [`stamp`].
pub fn caption(picture: &mut Picture, text: &str) {
    write(picture, text, CAPTION_PART, Place::Middle);
}

/// Returns the characters of a text that no font of the program or the system draws, each once.
pub fn missing_characters(text: &str) -> String {
    let mut missing = String::new();
    for character in text.chars().filter(|it| !is_ignorable(*it)) {
        if !missing.contains(character) && font_of(character).is_none() {
            missing.push(character);
        }
    }
    missing
}

/// Returns whether a character has no glyph of its own: controls, joiners, variation selectors.
fn is_ignorable(character: char) -> bool {
    character.is_control()
        || matches!(character, '\u{200b}'..='\u{200f}' | '\u{2060}' | '\u{fe00}'..='\u{fe0f}' | '\u{feff}')
}

/// Position of a line in a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Place {
    LowerLeft,
    Middle,
}

impl Place {
    /// Returns the upper left corner \[px\] of a backing of this width and height \[px\].
    fn corner(self, picture: &Picture, backing: [f32; 2], margin: f32) -> [f32; 2] {
        let (width, height) = (picture.width as f32, picture.height as f32);
        match self {
            Self::LowerLeft => [margin, height - margin - backing[1]],
            Self::Middle => [0.5 * (width - backing[0]), 0.5 * (height - backing[1])],
        }
    }
}

/// Writes a line whose text has the height `part` times that of the picture.
fn write(picture: &mut Picture, text: &str, part: f32, place: Place) {
    // The font of usual text is part of the program, so reading it cannot fail.
    let Some(KnownFont { font, .. }) = font_of(' ') else { return };
    let text = text.chars().filter(|it| !is_ignorable(*it)).take(LONGEST);
    let text: Vec<Character> = text.filter_map(Character::of).collect();
    let wished = (picture.height as f32 * part).max(SMALLEST);
    let Some(line) = fit(trimmed(&text), wished, picture.width as f32) else {
        return;
    };
    let size = line.size;
    let backing = [line.width + 2.0 * PADDING_X * size, (1.0 + 2.0 * PADDING_Y) * size];
    let [left, top] = place.corner(picture, backing, MARGIN * size);
    let rectangle = Rectangle { x: [left, left + backing[0]], y: [top, top + backing[1]] };
    darken(picture, &rectangle, size * CORNER);
    let ascent = font.as_scaled(PxScale::from(size)).ascent();
    let origin = [left + size * PADDING_X, top + size * PADDING_Y + ascent];
    for (font, mut glyph) in line.glyphs {
        glyph.position.x += origin[0];
        glyph.position.y += origin[1];
        draw(picture, &font.font, glyph);
    }
}

/// A character with the font that draws it.
#[derive(Clone)]
struct Character {
    character: char,
    font: KnownFont,
}

impl Character {
    fn of(character: char) -> Option<Self> {
        Some(Self { character, font: font_of(character)? })
    }
}

/// Returns a text without the spaces at both ends.
fn trimmed(text: &[Character]) -> &[Character] {
    let is_ink = |it: &Character| !it.character.is_whitespace();
    let (first, last) = (text.iter().position(is_ink), text.iter().rposition(is_ink));
    first.zip(last).map_or(&[], |(first, last)| &text[first..=last])
}

/// A line of text whose base line begins at the origin.
struct Line {
    /// Height of the text \[px\].
    size: f32,
    /// Width \[px\].
    width: f32,
    glyphs: Vec<(KnownFont, Glyph)>,
}

/// Sides in px from the upper left of the picture.
struct Rectangle {
    x: [f32; 2],
    y: [f32; 2],
}

/// Lays the text out at the `wished` size, or smaller if a picture of this `width` requires it
/// \[px\].
fn fit(text: &[Character], wished: f32, width: f32) -> Option<Line> {
    // The text and the space around it grow with the size.
    let around = |size: f32| 2.0 * (MARGIN + PADDING_X) * size;
    let line = line(text, wished);
    let needed = line.width + around(wished);
    if line.glyphs.is_empty() {
        return None;
    }
    if needed <= width {
        return Some(line);
    }
    let size = wished * width / needed;
    if size >= SMALLEST {
        return Some(self::line(text, size));
    }
    let ellipsis = Character::of('…')?;
    for kept in (1..text.len()).rev() {
        let cut = trimmed(&text[..kept]).iter().chain([&ellipsis]).cloned();
        let line = self::line(&cut.collect::<Vec<_>>(), SMALLEST);
        if line.width + around(SMALLEST) <= width {
            return Some(line);
        }
    }
    None
}

fn line(text: &[Character], size: f32) -> Line {
    let mut line = Line { size, width: 0.0, glyphs: Vec::new() };
    for Character { character, font } in text {
        let scaled = font.font.as_scaled(PxScale::from(size));
        let id = scaled.glyph_id(*character);
        // Glyphs of different fonts do not know each other.
        let last = line.glyphs.last().filter(|(of, _)| of.number == font.number);
        line.width += last.map_or(0.0, |(_, last)| scaled.kern(last.id, id));
        let glyph = id.with_scale_and_position(size, point(line.width, 0.0));
        line.glyphs.push((font.clone(), glyph));
        line.width += scaled.h_advance(id);
    }
    line
}

/// Draws a dark rectangle with round corners over the picture.
fn darken(picture: &mut Picture, rectangle: &Rectangle, corner: f32) {
    let Rectangle { x: [left, right], y: [top, bottom] } = *rectangle;
    for y in pixels_between(top, bottom, picture.height) {
        for x in pixels_between(left, right, picture.width) {
            let (cx, cy) = (x as f32 + 0.5, y as f32 + 0.5);
            // Distance beyond the rectangle that the corners' centres span.
            let dx = (left + corner - cx).max(cx - right + corner).max(0.0);
            let dy = (top + corner - cy).max(cy - bottom + corner).max(0.0);
            let inside = (corner - (dx * dx + dy * dy).sqrt()) / SOFTNESS + 0.5;
            let opacity = BACKING_OPACITY * inside.clamp(0.0, 1.0);
            blend(picture, x, y, 0.0, opacity);
        }
    }
}

/// Returns the pixels between two positions in a row or column of `count`, with one more on each
/// side.
fn pixels_between(low: f32, high: f32, count: u32) -> std::ops::Range<u32> {
    // `as` turns numbers out of range into the nearest valid one.
    let low = (low.floor() - 1.0) as u32;
    let high = (high.ceil() + 1.0) as u32;
    low.min(count)..high.min(count)
}

fn draw(picture: &mut Picture, font: &FontArc, glyph: Glyph) {
    let Some(outline) = font.outline_glyph(glyph) else {
        return;
    };
    let corner = outline.px_bounds().min;
    outline.draw(|x, y, coverage| {
        let (x, y) = (x as f32 + corner.x, y as f32 + corner.y);
        if x >= 0.0 && y >= 0.0 {
            // Coverage to the power of 3/4: thin strokes would look grey otherwise.
            let root = coverage.clamp(0.0, 1.0).sqrt();
            blend(picture, x as u32, y as u32, 255.0, root * root.sqrt());
        }
    });
}

/// Blends a grey of this brightness and opacity over a pixel, in sRGB, as browsers do.
fn blend(picture: &mut Picture, x: u32, y: u32, brightness: f32, opacity: f32) {
    if x >= picture.width || y >= picture.height {
        return;
    }
    let start = 4 * (y as usize * picture.width as usize + x as usize);
    let Some([red, green, blue, alpha]) = picture.pixels.get_mut(start..start + 4) else {
        return;
    };
    let below = f32::from(*alpha) / 255.0 * (1.0 - opacity);
    let whole = opacity + below;
    if whole > 0.0 {
        for part in [red, green, blue] {
            let mixed = (brightness * opacity + f32::from(*part) * below) / whole;
            *part = mixed.round() as u8;
        }
    }
    *alpha = (255.0 * whole).round() as u8;
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "simtest1  t = 3.200 s";

    fn plain(width: u32, height: u32, brightness: u8) -> Picture {
        let pixel = [brightness, brightness, brightness, 255];
        Picture { width, height, pixels: pixel.repeat((width * height) as usize) }
    }

    fn stamped(width: u32, height: u32, brightness: u8, text: &str) -> Picture {
        let mut picture = plain(width, height, brightness);
        stamp(&mut picture, text);
        picture
    }

    /// Returns the first and last changed column and row.
    fn changed(picture: &Picture, brightness: u8) -> Option<([u32; 2], [u32; 2])> {
        let (mut xs, mut ys) = (Vec::new(), Vec::new());
        for (i, pixel) in picture.pixels.chunks_exact(4).enumerate() {
            if pixel[..3] != [brightness; 3] {
                xs.push(i as u32 % picture.width);
                ys.push(i as u32 / picture.width);
            }
        }
        let bounds = |of: &[u32]| Some([*of.iter().min()?, *of.iter().max()?]);
        Some((bounds(&xs)?, bounds(&ys)?))
    }

    #[test]
    fn the_stamp_is_at_the_lower_left() {
        let ([left, right], [top, bottom]) = changed(&stamped(640, 480, 128, TEXT), 128).unwrap();
        assert!(left < 20 && right < 320, "{left} {right}");
        assert!(top > 440 && bottom > 460 && bottom < 479, "{top} {bottom}");
    }

    #[test]
    fn the_stamp_grows_with_the_picture() {
        let height = |rows: u32| {
            let (_, [top, bottom]) = changed(&stamped(2 * rows, rows, 128, TEXT), 128).unwrap();
            bottom - top
        };
        let (small, large) = (height(500), height(2000));
        // Edges are at whole pixels: 2 on each side.
        assert!(large.abs_diff(4 * small) <= 8, "{small} {large}");
    }

    #[test]
    fn a_caption_is_in_the_middle_and_large() {
        let mut picture = plain(640, 480, 128);
        caption(&mut picture, "You win!");
        let ([left, right], [top, bottom]) = changed(&picture, 128).unwrap();
        // Edges are at whole pixels: 1 on each side.
        assert!((left + right).abs_diff(639) <= 2, "{left} {right}");
        assert!((top + bottom).abs_diff(479) <= 2, "{top} {bottom}");
        assert!(right - left > 160 && bottom - top > 50, "{left} {right} {top} {bottom}");
    }

    /// Returns the contrast of WCAG 2: (L1 + 0.05) / (L2 + 0.05) of relative luminances.
    fn contrast(light: u8, dark: u8) -> f64 {
        let luminance = |level: u8| ((f64::from(level) / 255.0 + 0.055) / 1.055).powf(2.4);
        (luminance(light) + 0.05) / (luminance(dark) + 0.05)
    }

    #[test]
    fn the_stamp_stands_out_from_white_grey_and_black() {
        for brightness in [0, 128, 255] {
            let picture = stamped(1280, 720, brightness, TEXT);
            let size = 720.0 * TEXT_PART;
            // Between the backing's edge and the text.
            let x = (size * (MARGIN + 0.5 * PADDING_X)) as usize;
            let y = 719 - (size * (MARGIN + 0.5)) as usize;
            let backing = picture.pixels[4 * (y * 1280 + x)];
            // The middle row of the text; the picture's own white lies right of it.
            let row = 4 * 1280 * (719 - (size * (MARGIN + PADDING_Y + 0.4)) as usize);
            let text = picture.pixels[row..row + 4 * 200].chunks_exact(4).map(|pixel| pixel[0]);
            let text = text.skip(x).max().unwrap();
            assert!(contrast(text, backing) > 4.5, "{brightness}: {text} on {backing}");
        }
    }

    #[test]
    fn text_too_wide_stays_in_the_picture() {
        for width in [400, 200, 100, 60] {
            let picture = stamped(width, 300, 128, "a scene with quite a long name  t = 3.200 s");
            let (columns, _) = changed(&picture, 128).unwrap();
            assert!(columns[0] > 0 && columns[1] < width - 1, "{width}: {columns:?}");
        }
    }

    #[test]
    fn no_picture_and_no_text_is_too_small_or_too_odd() {
        for (width, height) in [(0, 0), (1, 1), (5, 300), (300, 5), (16, 16)] {
            for text in ["", " ", TEXT, "\n\u{1f3b1}\u{301}", &"x".repeat(10_000)] {
                stamped(width, height, 128, text);
            }
        }
        let mut broken = Picture { width: 640, height: 480, pixels: vec![0; 1000] };
        stamp(&mut broken, TEXT);
        assert_eq!(stamped(640, 480, 9, ""), plain(640, 480, 9), "no text, no stamp");
    }

    #[test]
    fn a_stamp_on_nothing_is_as_opaque_as_itself() {
        let mut picture = Picture { width: 640, height: 480, pixels: vec![0; 4 * 640 * 480] };
        stamp(&mut picture, TEXT);
        let opacities = picture.pixels.chunks_exact(4).map(|pixel| pixel[3]);
        let most_common = (255.0 * BACKING_OPACITY).round() as u8;
        assert!(opacities.filter(|opacity| *opacity == most_common).count() > 500);
    }

    #[test]
    fn a_character_that_no_font_draws_is_left_out_and_reported() {
        let odd = "\u{10fffe}simtest1  t = 3.200 s\u{10fffe}\u{fe0f}";
        assert_eq!(stamped(640, 480, 128, odd), stamped(640, 480, 128, TEXT));
        assert_eq!(missing_characters(odd), "\u{10fffe}");
        assert_eq!(missing_characters(TEXT), "");
    }

    #[test]
    fn every_character_has_ink_or_is_reported() {
        for character in "éΩж🎱球の구ბ".chars() {
            let picture = stamped(640, 480, 128, &format!("a{character}"));
            let is_missing = !missing_characters(&character.to_string()).is_empty();
            assert_eq!(picture == stamped(640, 480, 128, "a"), is_missing, "{character}");
        }
    }
}
