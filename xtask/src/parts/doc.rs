//! Documentation of Rust as docstrings of Python.

/// Columns of a line, at most.
pub const WIDTH: usize = 100;

/// Units that stand in brackets in Python, the longer of those that begin alike first.
const UNITS: [&str; 16] = [
    "m³/(kg s²)",
    "m³/s²",
    "m²/s",
    "m/s²",
    "m/s",
    "m",
    "rad/s",
    "kg/m³",
    "kg/s",
    "kg",
    "N/m",
    "N",
    "J",
    "Pa s",
    "degrees",
    "s",
];

/// A description of the schema in the words of Python: units in brackets, code in two backquotes.
pub fn of(description: &str) -> String {
    let mut text = description.split_whitespace().collect::<Vec<_>>().join(" ").replace('`', "``");
    if !text.ends_with(['.', '!', '?']) {
        text.push('.');
    }
    for unit in UNITS {
        for mark in [",", ";", ".", ":"] {
            text = text.replace(&format!(", in {unit}{mark}"), &format!(" [{unit}]{mark}"));
        }
    }
    text
}

/// A docstring with its quotes, at an indent: the first sentence alone, then the rest.
pub fn string(text: &str, indent: &str, sections: &[String]) -> String {
    let (first, rest) = match text.split_once(". ") {
        Some((first, rest)) => (format!("{first}."), rest),
        None => (text.to_owned(), ""),
    };
    let mut lines = vec![format!("{indent}\"\"\"{first}")];
    if !rest.is_empty() {
        lines.push(String::new());
        lines.extend(wrapped(rest, indent, indent));
    }
    if !sections.is_empty() {
        lines.push(String::new());
        lines.extend(sections.iter().cloned());
    }
    let is_long = lines[0].chars().count() + 3 > WIDTH;
    if lines.len() == 1 && !is_long {
        format!("{}\"\"\"", lines[0])
    } else {
        format!("{}\n{indent}\"\"\"", lines.join("\n"))
    }
}

/// Text in lines that begin with an indent: one for the first, another for the others.
pub fn wrapped(text: &str, first: &str, others: &str) -> Vec<String> {
    let mut lines = Vec::new();
    let mut line = first.to_owned();
    let mut is_empty = true;
    for word in text.split(' ') {
        let space = usize::from(!is_empty);
        if !is_empty && line.chars().count() + space + word.chars().count() > WIDTH {
            lines.push(std::mem::replace(&mut line, others.to_owned()));
            is_empty = true;
        }
        if !is_empty {
            line.push(' ');
        }
        line.push_str(word);
        is_empty = false;
    }
    lines.push(line);
    lines
}

#[cfg(test)]
mod tests {
    use super::{of, string, wrapped};

    #[test]
    fn units_stand_in_brackets_and_code_in_two_backquotes() {
        assert_eq!(
            of("Mass, in kg, > 0; 1 unless\n`density` is given"),
            "Mass [kg], > 0; 1 unless ``density`` is given."
        );
        assert_eq!(of("Velocity, in m/s."), "Velocity [m/s].");
        assert_eq!(of("Where it is, in m from the axis."), "Where it is, in m from the axis.");
    }

    #[test]
    fn a_docstring_begins_with_a_sentence_alone() {
        assert_eq!(string("One.", "    ", &[]), "    \"\"\"One.\"\"\"");
        let section = ["    Attributes:".to_owned()];
        let expected = "\"\"\"One.\n\nTwo. Three.\n\n    Attributes:\n\"\"\"";
        assert_eq!(string("One. Two. Three.", "", &section), expected);
    }

    #[test]
    fn lines_break_before_the_margin() {
        let lines = wrapped("word ".repeat(25).trim_end(), "  ", "    ");
        assert_eq!(lines.iter().map(String::len).collect::<Vec<_>>(), [96, 33]);
    }
}
