//! Beginnings of texts, for errors.

/// Longest quotation from a link in an error \[characters\].
const LONGEST_QUOTATION: usize = 40;

/// The beginning of what a link says.
pub fn quoted(text: &str) -> String {
    shortened(text, LONGEST_QUOTATION)
}

/// A text, or the beginning of one with more than `longest` characters.
pub fn shortened(text: &str, longest: usize) -> String {
    let mut shortened: String = text.chars().take(longest).collect();
    if shortened.len() < text.len() {
        shortened.push_str("...");
    }
    shortened
}
