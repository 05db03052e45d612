//! The typefaces of the interface.
//!
//! A host adds those of its system or browser for all other characters.

use std::sync::Arc;

use carom_render::TEXT_FONT;
use egui::{Context, FontData, FontDefinitions, FontFamily, FontTweak};

/// Letters, digits and punctuation of one width.
const HACK: &[u8] = include_bytes!("../fonts/hack.ttf");
/// Signs on buttons.
const ICONS: &[u8] = include_bytes!("../fonts/emoji-icon-font.ttf");
/// Signs on buttons, and, outside of browsers, which have their own, all emoji.
#[cfg(target_arch = "wasm32")]
const EMOJI: &[u8] = include_bytes!("../fonts/noto-emoji.ttf");
#[cfg(not(target_arch = "wasm32"))]
const EMOJI: &[u8] = epaint_default_fonts::NOTO_EMOJI_REGULAR;

/// Sets the typefaces of a context.
pub fn install(context: &Context) {
    context.set_fonts(definitions());
}

fn definitions() -> FontDefinitions {
    let mut fonts = FontDefinitions::empty();
    // Emoji are drawn larger than letters of the same size.
    let scaled = |data, scale| {
        FontData::from_static(data).tweak(FontTweak { scale, ..FontTweak::default() })
    };
    for (name, data) in [
        ("Hack", scaled(HACK, 1.0)),
        ("Ubuntu-Light", scaled(TEXT_FONT, 1.0)),
        ("NotoEmoji", scaled(EMOJI, 0.81)),
        ("emoji-icon-font", scaled(ICONS, 0.9)),
    ] {
        fonts.font_data.insert(name.to_owned(), Arc::new(data));
    }
    let order = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect();
    let proportional = ["Ubuntu-Light", "NotoEmoji", "emoji-icon-font"];
    let monospace = ["Hack", "Ubuntu-Light", "NotoEmoji", "emoji-icon-font"];
    fonts.families.insert(FontFamily::Proportional, order(&proportional));
    fonts.families.insert(FontFamily::Monospace, order(&monospace));
    fonts
}
