//! Fonts of texts on pictures: the built-in ones, and those of the system for other characters.

use std::collections::BTreeMap;
use std::sync::{LazyLock, Mutex, PoisonError};

use ab_glyph::{Font, FontArc, FontRef};

/// A font, and its number among those that are in use.
#[derive(Debug, Clone)]
pub struct KnownFont {
    pub number: usize,
    pub font: FontArc,
}

/// Returns a font that draws a character, or `None` if neither the program nor the system has one.
pub fn font_of(character: char) -> Option<KnownFont> {
    static FONTS: LazyLock<Mutex<Fonts>> = LazyLock::new(|| Mutex::new(Fonts::built_in()));
    let mut fonts = FONTS.lock().unwrap_or_else(PoisonError::into_inner);
    let number = fonts.number_of(character)?;
    Some(KnownFont { number, font: fonts.known.get(number)?.clone() })
}

/// Fonts, and which of them draws a character.
struct Fonts {
    /// The first is that of usual texts.
    known: Vec<FontArc>,
    /// Numbers of fonts; `None` where there is no font.
    of_characters: BTreeMap<char, Option<usize>>,
}

impl Fonts {
    fn built_in() -> Self {
        let fonts = BUILT_IN.iter().filter_map(|data| FontRef::try_from_slice(data).ok());
        Self { known: fonts.map(FontArc::new).collect(), of_characters: BTreeMap::new() }
    }

    fn number_of(&mut self, character: char) -> Option<usize> {
        if let Some(number) = self.of_characters.get(&character) {
            return *number;
        }
        let known = self.known.iter().position(|font| draws(font, character));
        let number = known.or_else(|| {
            self.known.push(of_system(character).filter(|font| draws(font, character))?);
            Some(self.known.len() - 1)
        });
        self.of_characters.insert(character, number);
        number
    }
}

/// Returns whether a font has a character, with an outline: some fonts have pictures only.
fn draws(font: &FontArc, character: char) -> bool {
    let glyph = font.glyph_id(character);
    glyph.0 != 0 && (character.is_whitespace() || font.outline(glyph).is_some())
}

/// A font file (TrueType) for usual texts; for pages only its Latin and Greek letters and signs.
#[cfg(target_arch = "wasm32")]
pub const TEXT_FONT: &[u8] = include_bytes!("../fonts/ubuntu-light.ttf");
/// A font file (TrueType) for usual texts.
#[cfg(not(target_arch = "wasm32"))]
pub const TEXT_FONT: &[u8] = epaint_default_fonts::UBUNTU_LIGHT;

#[cfg(target_arch = "wasm32")]
const BUILT_IN: [&[u8]; 1] = [TEXT_FONT];
#[cfg(not(target_arch = "wasm32"))]
const BUILT_IN: [&[u8]; 2] = [TEXT_FONT, epaint_default_fonts::NOTO_EMOJI_REGULAR];

/// A page cannot read the fonts of its browser.
#[cfg(target_arch = "wasm32")]
fn of_system(_character: char) -> Option<FontArc> {
    None
}

#[cfg(not(target_arch = "wasm32"))]
fn of_system(character: char) -> Option<FontArc> {
    use ab_glyph::FontVec;
    use egui_system_font_provider::SystemFontProvider;
    use epaint::text::{FallbackRequest, FontFamily, FontProvider};

    // Listing the fonts of a system takes some time.
    static SYSTEM: LazyLock<SystemFontProvider> = LazyLock::new(SystemFontProvider::new);
    let cluster = character.to_string();
    let family = FontFamily::Proportional;
    let found = SYSTEM.font_for(&FallbackRequest { cluster: &cluster, family: &family })?;
    let (bytes, index) = (found.data.bytes().to_vec(), found.data.index);
    FontVec::try_from_vec_and_index(bytes, index).ok().map(FontArc::new)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn usual_texts_and_emoji_need_no_font_of_the_system() {
        for character in (' '..='~').chain("äöüÄÖÜßéµ°±×·…²³Ωж🎱".chars()) {
            let fonts = &mut Fonts::built_in();
            let built_in = fonts.known.len();
            assert!(fonts.number_of(character).is_some_and(|it| it < built_in), "{character}");
        }
    }

    #[test]
    fn a_font_of_the_system_draws_what_it_is_found_for() {
        // Chinese, Japanese, Korean, Georgian; a machine may have none of them.
        for character in "球の구ბ".chars() {
            assert!(font_of(character).is_none_or(|it| draws(&it.font, character)), "{character}");
        }
        assert!(font_of('\u{10fffe}').is_none(), "no font has a character that is none");
    }
}
