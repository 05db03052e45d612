//! Checks that links of documents lead somewhere, and that the files and types that they name
//! exist.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use crate::files::normal;
use crate::markdown::{Markdown, Spot};
use crate::shell::{Outcome, root};

/// Folders of foreign or generated files.
const FOREIGN: [&str; 9] = [
    ".git",
    "__pycache__",
    "dist",
    "environment",
    "module",
    "node_modules",
    "out",
    "target",
    "test-results",
];
/// Documents that name past files and types.
const HISTORIES: [&str; 1] = ["CHANGELOG.md"];
/// Names from other codes, from cited programs, and of generated files.
const FOREIGN_NAMES: [&str; 2] = ["GetTimeOfIntersection", "out/"];
/// Extensions of files that a document may name.
const ENDINGS: [&str; 8] = ["rs", "md", "py", "pyi", "toml", "txt", "wgsl", "yml"];
/// Extensions of sources, whose words are the names that a document may use.
const SOURCES: [&str; 8] = ["rs", "py", "pyi", "js", "ts", "toml", "h", "cs"];

/// Reports dead links, and names of files and types that do not exist.
pub fn check() -> Outcome {
    let files = Files::of_repository()?;
    let mut faults = Vec::new();
    for file in files.paths.iter().filter(|file| file.ends_with(".md")) {
        let document = read(file)?;
        for link in &document.links {
            faults.extend(fault_of_link(&files, file, link)?.map(|fault| at(file, link, &fault)));
        }
        if HISTORIES.contains(&file.as_str()) || is_of_a_package(file) {
            continue;
        }
        for code in own_code(file, &document)? {
            faults.extend(files.fault_of_name(&document, &code).map(|it| at(file, &code, &it)));
        }
    }
    if faults.is_empty() { Ok(()) } else { Err(format!("documents:\n{}", faults.join("\n"))) }
}

/// Reads and parses a document of the repository.
pub fn read(file: &str) -> Outcome<Markdown> {
    Ok(Markdown::parse(&text(file)?))
}

/// Reads the text of a document of the repository.
pub fn text(file: &str) -> Outcome<String> {
    fs::read_to_string(root().join(file)).map_err(|error| format!("{file}: {error}"))
}

fn at(file: &str, spot: &Spot, fault: &str) -> String {
    format!("  {file}:{}: {fault}", spot.line)
}

/// Returns whether a document is part of a package, so that users read it away from the repository.
fn is_of_a_package(file: &str) -> bool {
    file.starts_with("python/") || file.starts_with("web/")
}

/// Returns the code in a document that is about Carom. The last column of the glossary's tables is
/// about other codes.
fn own_code(file: &str, document: &Markdown) -> Outcome<Vec<Spot>> {
    if file != "docs/glossary.md" {
        return Ok(document.code.clone());
    }
    let text = text(file)?;
    let lines: Vec<&str> = text.lines().map(without_last_cell).collect();
    Ok(Markdown::parse(&lines.join("\n")).code)
}

fn without_last_cell(line: &str) -> &str {
    let row = line.strip_suffix('|').and_then(|row| row.rsplit_once('|'));
    row.map_or(line, |(rest, _)| rest)
}

/// Returns the fault of a link to a place in the repository, if it has one.
fn fault_of_link(files: &Files, from: &str, link: &Spot) -> Outcome<Option<String>> {
    let target = link.text.as_str();
    if target.contains("://") || target.starts_with("mailto:") {
        return Ok(None);
    }
    let (path, anchor) = target.split_once('#').map_or((target, None), |(a, b)| (a, Some(b)));
    let file = if path.is_empty() { from.to_owned() } else { resolved(from, path) };
    if !files.has(&file) {
        return Ok(Some(format!("the link to {target} leads nowhere")));
    }
    let Some(anchor) = anchor else { return Ok(None) };
    let is_there = file.ends_with(".md") && read(&file)?.anchors.iter().any(|it| it == anchor);
    Ok((!is_there).then(|| format!("{file} has no heading #{anchor}")))
}

/// Converts a relative path in a document to one from the root of the repository.
fn resolved(from: &str, path: &str) -> String {
    let folder = Path::new(from).parent().unwrap_or(Path::new(""));
    normal(&folder.join(path)).to_string_lossy().into_owned()
}

/// Files, folders and words that documents may name.
#[derive(Default)]
struct Files {
    /// Paths from the root of the repository, with `/`.
    paths: BTreeSet<String>,
    folders: BTreeSet<String>,
    /// All words of the sources.
    words: BTreeSet<String>,
}

impl Files {
    fn of_repository() -> Outcome<Self> {
        let mut files = Self::default();
        files.add_folder(&root(), "")?;
        Ok(files)
    }

    fn add_folder(&mut self, folder: &Path, name: &str) -> Outcome {
        let said = |error: std::io::Error| format!("{}: {error}", folder.display());
        for entry in fs::read_dir(folder).map_err(said)? {
            let path = entry.map_err(said)?.path();
            let own = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            let place = format!("{name}{own}");
            if !path.is_dir() {
                self.add_words(&path, &place)?;
                self.paths.insert(place);
            } else if !FOREIGN.contains(&own.as_str()) {
                self.add_folder(&path, &format!("{place}/"))?;
                self.folders.insert(place);
            }
        }
        Ok(())
    }

    fn add_words(&mut self, path: &Path, place: &str) -> Outcome {
        let is_source =
            ["bevy/", "crates/", "python/", "web/"].iter().any(|it| place.starts_with(it));
        if !is_source || !ends_with_one_of(place, &SOURCES) {
            return Ok(());
        }
        let text = fs::read_to_string(path).map_err(|error| format!("{place}: {error}"))?;
        let words = text.split(|letter: char| !is_of_a_word(letter)).filter(|it| !it.is_empty());
        self.words.extend(words.map(str::to_owned));
        Ok(())
    }

    fn has(&self, path: &str) -> bool {
        let path = path.trim_end_matches('/');
        path.is_empty() || self.paths.contains(path) || self.folders.contains(path)
    }

    /// Returns the fault of code in a sentence, if it names a missing file, folder or type.
    fn fault_of_name(&self, document: &Markdown, code: &Spot) -> Option<String> {
        let name = code.text.as_str();
        if FOREIGN_NAMES.contains(&name) {
            return None;
        }
        if is_file(name) {
            let is_made_on_the_way = document.blocks.iter().any(|it| it.text.contains(name));
            let is_there = is_made_on_the_way || ends_in(&self.paths, name);
            return (!is_there).then(|| format!("there is no file `{name}`"));
        }
        if is_folder(name) {
            let is_there = ends_in(&self.folders, name.trim_end_matches('/'));
            return (!is_there).then(|| format!("there is no folder `{name}`"));
        }
        let missing = names_of_types(name).into_iter().find(|word| !self.words.contains(*word))?;
        Some(format!("no source has the word {missing} of `{name}`"))
    }
}

/// Returns whether one of these paths equals this one or ends in it.
fn ends_in(paths: &BTreeSet<String>, name: &str) -> bool {
    let name = name.trim_start_matches("./");
    paths.contains(name) || paths.iter().any(|path| path.ends_with(&format!("/{name}")))
}

fn ends_with_one_of(name: &str, endings: &[&str]) -> bool {
    name.rsplit_once('.')
        .is_some_and(|(stem, ending)| !stem.is_empty() && endings.contains(&ending))
}

fn is_of_a_word(letter: char) -> bool {
    letter.is_alphanumeric() || letter == '_'
}

fn is_path(name: &str) -> bool {
    name.chars().all(|letter| letter.is_ascii_alphanumeric() || "._-/".contains(letter))
}

fn is_file(name: &str) -> bool {
    is_path(name) && ends_with_one_of(name, &ENDINGS) && !name.starts_with('/')
}

fn is_folder(name: &str) -> bool {
    is_path(name) && name.ends_with('/') && name.len() > 1
}

/// Returns the words of a name such as `World::step` or `MAX_STEPS`; none if it names no type,
/// function or constant.
fn names_of_types(name: &str) -> Vec<&str> {
    let name = name.strip_suffix("()").unwrap_or(name);
    let name = name.strip_prefix("carom.").unwrap_or(name);
    let words: Vec<&str> = name.split("::").flat_map(|part| part.split('.')).collect();
    let is_name = |word: &&str| {
        word.len() > 1
            && word.chars().all(|letter| letter.is_ascii_alphanumeric() || letter == '_')
            && !word.starts_with(|first: char| first.is_ascii_digit())
    };
    // Capitals alone are abbreviations, for example `CSV`.
    let is_long = name.len() > 3 || name.contains(|letter: char| letter.is_ascii_lowercase());
    let begins_large = name.starts_with(|first: char| first.is_ascii_uppercase());
    if is_long && begins_large && words.iter().all(is_name) { words } else { Vec::new() }
}

#[cfg(test)]
mod tests {
    use super::{Files, Spot, is_file, is_folder, names_of_types, resolved, without_last_cell};
    use crate::markdown::Markdown;

    #[test]
    fn links_are_followed_from_the_folder_of_their_document() {
        assert_eq!(resolved("docs/physics/exact.md", "motion.md"), "docs/physics/motion.md");
        assert_eq!(resolved("docs/physics/exact.md", "../../README.md"), "README.md");
        assert_eq!(resolved("README.md", "docs/viewer.md"), "docs/viewer.md");
    }

    #[test]
    fn names_of_files_folders_and_types_are_recognised() {
        assert!(is_file("work.rs") && is_file("docs/x.md") && is_file("./scenes/x.toml"));
        assert!(!is_file("/dev/stdout") && !is_file("carom run x.toml") && !is_file(".rs"));
        assert!(is_folder("rule/exact/") && !is_folder("/") && !is_folder("a b/"));
        assert_eq!(names_of_types("World::step"), ["World", "step"]);
        assert_eq!(names_of_types("MAX_STEPS"), ["MAX_STEPS"]);
        assert_eq!(names_of_types("carom.Batch"), ["Batch"]);
        for other in ["e", "carom run", "F = m g", "wind_back = \"all\"", "MAX STEPS"] {
            assert!(names_of_types(other).is_empty(), "{other}");
        }
    }

    #[test]
    fn names_that_are_not_there_are_found() {
        let mut files = Files::default();
        files.paths.insert("crates/carom/src/work.rs".to_owned());
        files.folders.insert("crates/carom/src".to_owned());
        files.words.extend(["World", "step"].map(str::to_owned));
        let document = Markdown::parse("```toml\n# file: mine.toml\n```\n");
        let has_fault = |name: &str| {
            let code = Spot { line: 1, text: name.to_owned() };
            files.fault_of_name(&document, &code).is_some()
        };
        for name in ["work.rs", "src/work.rs", "mine.toml", "src/", "World::step", "exact"] {
            assert!(!has_fault(name), "{name}");
        }
        for name in ["ork.rs", "src/play.rs", "your.toml", "rc/", "World::leap", "Wold"] {
            assert!(has_fault(name), "{name}");
        }
    }

    #[test]
    fn the_last_cell_of_a_row_is_cut_off() {
        assert_eq!(without_last_cell("| a | `b` | `Other` |"), "| a | `b` ");
        assert_eq!(without_last_cell("no row"), "no row");
    }
}
