//! Texts of files and links in messages: they may be long, and must not steer what shows them.

/// A text in one line: control characters and marks that turn the direction of text are written out as
/// `\u{...}`, and where that is more
/// than `longest` characters, the beginning is left.
///
/// ```
/// use carom_scene::legible;
///
/// assert_eq!(legible("tom\u{1b}[31mato", 20), "tom\\u{1b}[31mato");
/// assert_eq!(legible("cornucopia", 4), "corn...");
/// ```
pub fn legible(text: &str, longest: usize) -> String {
    let mut line = String::new();
    let mut length = 0;
    for character in text.chars() {
        if length >= longest {
            return line + "...";
        }
        let before = line.len();
        if steers(character) {
            line.extend(character.escape_unicode());
            length += line.len() - before;
        } else {
            line.push(character);
            length += 1;
        }
    }
    line
}

/// Whether a character does something to what shows it: controls, ends of lines, and marks that turn the
/// direction of the text after them (Unicode Standard Annex 9).
pub fn steers(character: char) -> bool {
    let turns = matches!(character,
        '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    turns || character.is_control() || matches!(character, '\u{2028}' | '\u{2029}')
}
