//! Source text without its comments and strings.

use super::language::Language;

/// The text with comments taken out, and in Python and C# what stands in strings; lines stay lines.
pub fn of(text: &str, language: Language) -> String {
    let keeps_strings = language == Language::JavaScript;
    let mut code = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(letter) = rest.chars().next() {
        let (length, kind) = piece(rest, language);
        let (taken, left) = rest.split_at(length.max(letter.len_utf8()));
        match kind {
            Kind::Code => code.push_str(taken),
            Kind::Text if keeps_strings => code.push_str(taken),
            Kind::Text | Kind::Comment => code.extend(taken.chars().filter(|it| *it == '\n')),
        }
        rest = left;
    }
    code
}

enum Kind {
    Code,
    Text,
    Comment,
}

/// How long the piece is with which a text begins, and what it is.
fn piece(rest: &str, language: Language) -> (usize, Kind) {
    let is_python = language == Language::Python;
    let line = rest.find('\n').unwrap_or(rest.len());
    if is_python && rest.starts_with('#') || !is_python && rest.starts_with("//") {
        return (line, Kind::Comment);
    }
    if !is_python && rest.starts_with("/*") {
        return (rest.find("*/").map_or(rest.len(), |end| end + 2), Kind::Comment);
    }
    let quotes: &[&str] = match language {
        Language::Python => &["\"\"\"", "'''", "\"", "'"],
        Language::JavaScript => &["\"", "'", "`"],
        Language::CSharp => &["\"", "'"],
    };
    match quotes.iter().find(|quote| rest.starts_with(**quote)) {
        Some(quote) => (length_of_string(rest, quote), Kind::Text),
        None => (0, Kind::Code),
    }
}

/// How long the string is with which a text begins, both quotes with it. One of a single line ends
/// with the line at the latest, so that an apostrophe that begins none does no harm.
fn length_of_string(rest: &str, quote: &str) -> usize {
    let spans_lines = quote.len() == 3 || quote == "`";
    let mut at = quote.len();
    while let Some(letter) = rest[at..].chars().next() {
        if rest[at..].starts_with(quote) {
            return at + quote.len();
        }
        if letter == '\n' && !spans_lines {
            return at;
        }
        at += letter.len_utf8();
        if letter == '\\' {
            at += rest[at..].chars().next().map_or(0, char::len_utf8);
        }
    }
    rest.len()
}

#[cfg(test)]
mod tests {
    use super::of;
    use crate::scripts::Language;

    #[test]
    fn comments_and_strings_of_python_are_not_code() {
        let text =
            "import a  # import b\n\"\"\"Doc.\n\nimport c\n\"\"\"\nx = 'import d \\' #'\ny = 1\n";
        assert_eq!(of(text, Language::Python), "import a  \n\n\n\n\nx = \ny = 1\n");
    }

    #[test]
    fn comments_of_javascript_are_not_code_and_its_strings_are() {
        let text = "import \"./a.js\"; // b\n/** @type {import(\"./c.js\").C} */\nf(`// d`);\n";
        assert_eq!(of(text, Language::JavaScript), "import \"./a.js\"; \n\nf(`// d`);\n");
    }

    #[test]
    fn an_apostrophe_that_begins_no_string_ends_with_its_line() {
        assert_eq!(of("a = '\nb = 2\n", Language::CSharp), "a = \nb = 2\n");
    }
}
