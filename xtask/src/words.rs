//! Checks that comments and documents use plain words.

use std::fs;
use std::path::Path;

use crate::shell::{Outcome, root};

/// Words that are not needed anywhere.
const WORDS: [&str; 5] = ["whoever", "nobody", "reckoned", "vicinity", "outlook"];
/// Openings that refer to another comment.
const OPENINGS: [&str; 3] = ["Likewise", "As there.", "The same."];
/// Openings of doc comments that say less than "Returns", "Applies" or "Moves".
const DOC_OPENINGS: [&str; 3] = ["Gives ", "In which ", "Tells "];
/// Openings of fragments, which only the code around them explains.
const FRAGMENTS: [&str; 4] = ["By ", "Its ", "Of ", "Those "];
/// Phrases without an actor, or with a wrong term.
const PHRASES: [&str; 12] = [
    "are asked",
    "are told",
    "be told",
    "is asked",
    "is told",
    "lasting contact",
    "lasting contacts",
    "told apart",
    "told to",
    "unless told",
    "who is near",
    "whom",
];

/// Folders and documents that are checked.
const PLACES: [&str; 9] = [
    "bevy",
    "crates",
    "xtask",
    "python",
    "docs",
    "web",
    "README.md",
    "ARCHITECTURE.md",
    "CHANGELOG.md",
];
const ENDINGS: [&str; 7] = ["rs", "py", "pyi", "md", "ts", "mjs", "js"];
/// Folders of foreign or generated files.
const FOREIGN: [&str; 5] = ["node_modules", "target", "dist", "module", "test-results"];

/// Reports such words, openings and phrases in sources and documents.
pub fn check() -> Outcome {
    let mut faults = Vec::new();
    for place in PLACES {
        check_place(&root().join(place), &mut faults).map_err(|error| error.to_string())?;
    }
    if faults.is_empty() { Ok(()) } else { Err(format!("plain words:\n{}", faults.join("\n"))) }
}

fn check_place(path: &Path, faults: &mut Vec<String>) -> std::io::Result<()> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    if path.is_dir() {
        if !FOREIGN.contains(&name.as_ref()) {
            for entry in fs::read_dir(path)? {
                check_place(&entry?.path(), faults)?;
            }
        }
        return Ok(());
    }
    let ending = path.extension().unwrap_or_default().to_string_lossy();
    let is_this_list = path.ends_with("xtask/src/words.rs");
    if !ENDINGS.contains(&ending.as_ref()) || is_this_list {
        return Ok(());
    }
    let text = fs::read_to_string(path)?;
    let mut before = "";
    for (number, line) in (1..).zip(text.lines()) {
        let before = std::mem::replace(&mut before, line);
        let fault = fault_of(line).or_else(|| phrase_of(line));
        if let Some(fault) = fault.or_else(|| fragment_of(before, line)) {
            let place = path.strip_prefix(root()).unwrap_or(path).display();
            faults.push(format!("{place}:{number}: \"{fault}\" in: {}", line.trim()));
        }
    }
    Ok(())
}

/// Returns the refused word or opening of a line, if there is one.
fn fault_of(line: &str) -> Option<&'static str> {
    let mut words = line.split(|letter: char| !letter.is_alphanumeric() && letter != '_');
    let is_refused = |word: &&str| WORDS.iter().any(|it| is_word(it, word));
    if let Some(word) = words.find(is_refused) {
        return WORDS.into_iter().find(|it| is_word(it, word));
    }
    let marks = |letter: char| "/!*#\"-| ".contains(letter);
    let text = line.trim_start_matches(marks);
    let is_doc = ["/// ", "//! "].iter().any(|mark| line.trim_start().starts_with(mark));
    let of_docs = DOC_OPENINGS.iter().filter(|_| is_doc);
    OPENINGS.iter().chain(of_docs).copied().find(|opening| text.starts_with(opening))
}

/// Returns the opening of a fragment, if a doc comment begins with one in this line.
fn fragment_of(before: &str, line: &str) -> Option<&'static str> {
    let is_doc = |line: &str| line.trim_start().starts_with("///");
    let text = line.trim_start().strip_prefix("/// ")?;
    FRAGMENTS.into_iter().find(|opening| !is_doc(before) && text.starts_with(opening))
}

/// Returns the refused phrase of a line, if there is one; capitals do not matter.
fn phrase_of(line: &str) -> Option<&'static str> {
    let line = line.to_ascii_lowercase();
    let is_within_a_word =
        |letter: Option<char>| letter.is_some_and(|it| it.is_alphanumeric() || it == '_');
    PHRASES.into_iter().find(|phrase| {
        line.match_indices(phrase).any(|(at, _)| {
            let (before, after) = (&line[..at], &line[at + phrase.len()..]);
            !is_within_a_word(before.chars().next_back()) && !is_within_a_word(after.chars().next())
        })
    })
}

/// Returns whether `found` is the word, with a small or capital first letter. Names in capitals do
/// not count.
fn is_word(word: &str, found: &str) -> bool {
    let mut letters = found.chars();
    let first = letters.next().map(|letter| letter.to_ascii_lowercase());
    first.into_iter().chain(letters).eq(word.chars())
}

#[cfg(test)]
mod tests {
    use super::{fault_of, fragment_of, phrase_of};

    #[test]
    fn refused_words_and_openings_are_found() {
        assert_eq!(fault_of("/// Likewise for a sphere."), Some("Likewise"));
        assert_eq!(fault_of("    // Nobody reads it, so"), Some("nobody"));
        assert_eq!(fault_of("the times, reckoned anew"), Some("reckoned"));
        assert_eq!(fault_of("/// The same. For all."), Some("The same."));
        assert_eq!(fault_of("    /// Gives the time."), Some("Gives "));
        assert_eq!(fault_of("// Gives the time."), None);
    }

    #[test]
    fn fragments_are_found_where_a_doc_comment_begins() {
        assert_eq!(fragment_of("struct Flights {", "    /// By slot."), Some("By "));
        assert_eq!(fragment_of("    speed: f64,", "    /// Its radius."), Some("Its "));
        assert_eq!(fragment_of("/// The radius.", "/// Its unit is the metre."), None);
        assert_eq!(fragment_of("", "// Of two, the first."), None);
    }

    #[test]
    fn phrases_are_found_as_whole_words() {
        assert_eq!(phrase_of("Forces in lasting contact."), Some("lasting contact"));
        assert_eq!(phrase_of("a solver is told where"), Some("is told"));
        for line in ["an everlasting contact", "this tolerance", "told tomorrow"] {
            assert_eq!(phrase_of(line), None, "{line}");
        }
    }

    #[test]
    fn phrases_are_found_in_sources() {
        assert_eq!(phrase_of("/// What the driver is told."), Some("is told"));
        assert_eq!(phrase_of("//! Lasting contact: rest on a floor."), Some("lasting contact"));
        assert_eq!(phrase_of("// Emitters, told apart by place."), Some("told apart"));
        assert_eq!(phrase_of("test(\"tries again when told to\", async () => {"), Some("told to"));
        for line in ["let is_told = told.is_some();", "for told in told_apart {"] {
            assert_eq!(phrase_of(line), None, "{line}");
        }
    }

    #[test]
    fn other_lines_pass() {
        for line in ["const NOBODY: i64 = -1;", "counts as there.", "let nobody_is = 1;", ""] {
            assert_eq!(fault_of(line), None, "{line}");
        }
    }
}
