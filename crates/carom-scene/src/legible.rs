//! Makes texts of files and links safe for messages: short, and without control characters.

/// Writes a text in one line. Control characters and marks of text direction become `\u{...}`; a
/// line longer than `longest` characters is cut.
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

/// Whether a character affects how the text around it is shown: control characters, line ends, and
/// marks of text direction (Unicode Standard Annex 9).
pub fn steers(character: char) -> bool {
    let turns = matches!(character,
        '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    turns || character.is_control() || matches!(character, '\u{2028}' | '\u{2029}')
}
