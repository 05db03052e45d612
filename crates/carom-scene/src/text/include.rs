//! Scene files that include others.

use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use toml::{Table, Value};

use super::source::SourceText;
use crate::budget::Budget;
use crate::error::{SceneError, did_you_mean};
use crate::plain_text::{NotText, text_of};
use crate::table::INCLUDE;

/// Most files of one scene: a mistake, or an attack, could include files without end.
const MOST_FILES: usize = 100;

/// Fields that describe a file itself; they are not taken from included files.
const OWN: [&str; 4] = ["name", "title", "description", "origin"];

/// Lists of a scene: elements of included files come before those of the file.
const LISTS: [&str; 7] =
    ["forces", "material_pairs", "spheres", "generators", "springs", "colliders", "emitters"];

/// Whether a field is a list to which all files of a scene add elements.
pub(super) fn is_list(field: &str) -> bool {
    LISTS.contains(&field)
}

/// Returns the text of a file, after those of the files that it includes, in order and without
/// those in `met`. `way` is the path of inclusion that leads to the file.
pub(super) fn with_included(
    mut own: SourceText,
    way: &[PathBuf],
    budget: Budget,
    met: &mut Vec<PathBuf>,
) -> Result<Vec<SourceText>, SceneError> {
    let mut sources = Vec::new();
    let Some(included) = own.table.remove(INCLUDE) else {
        sources.push(own);
        return Ok(sources);
    };
    let refused = |problem: &str| Err(own.fault(INCLUDE, problem).into());
    let Some(names) = names(&included) else {
        return refused("must be the path of a scene file, or a list of such");
    };
    for name in names {
        let Some(path) = way.last() else {
            return refused("only scenes in files can include files");
        };
        let path = path.parent().unwrap_or(Path::new("")).join(name);
        if way.iter().any(|other| is_same(other, &path)) {
            return refused(&format!("\"{name}\" includes this file"));
        }
        if met.iter().any(|other| is_same(other, &path)) {
            continue;
        }
        met.push(path.clone());
        if met.len() >= MOST_FILES {
            return refused(&format!("a scene has {MOST_FILES} files at most"));
        }
        let text = match read(&path, budget.bytes) {
            Ok(text) => text,
            Err(error) => {
                let with_ending = Path::new(name).with_extension("toml").display().to_string();
                let is_meant = path.with_extension("toml").is_file() && with_ending != name;
                let meant = did_you_mean(&is_meant.then_some(with_ending));
                return refused(&format!("cannot read \"{name}\": {error}{meant}"));
            }
        };
        let mut other = SourceText::new(&path.display().to_string(), &text)?;
        other.table.retain(|field, _| !OWN.contains(&field));
        let way: Vec<PathBuf> = way.iter().cloned().chain([path]).collect();
        sources.extend(with_included(other, &way, budget, met)?);
    }
    sources.push(own);
    Ok(sources)
}

/// Lists a file and all files that it includes, directly or indirectly, as far as they can be read.
pub(crate) fn named_files(path: &Path) -> Vec<PathBuf> {
    let mut files: Vec<PathBuf> = Vec::new();
    let mut waiting = vec![path.to_owned()];
    while let Some(path) = waiting.pop().filter(|_| files.len() < MOST_FILES) {
        let text = read(&path, Budget::FILE.bytes).unwrap_or_default();
        let table: Table = toml::from_str(&text).unwrap_or_default();
        let folder = path.parent().unwrap_or(Path::new(""));
        let named = table.get(INCLUDE).and_then(names).unwrap_or_default();
        let named: Vec<PathBuf> = named.into_iter().map(|name| folder.join(name)).collect();
        files.push(path);
        waiting.extend(named.into_iter().filter(|it| !files.contains(it)));
    }
    files
}

/// Reads one path or a list of paths.
fn names(included: &Value) -> Option<Vec<&str>> {
    match included {
        Value::String(name) => Some(vec![name]),
        Value::Array(names) => names.iter().map(Value::as_str).collect(),
        _ => None,
    }
}

fn is_same(one: &Path, other: &Path) -> bool {
    let [one, other] = [one, other].map(std::fs::canonicalize);
    one.is_ok_and(|one| other.is_ok_and(|other| one == other))
}

fn read(path: &Path, most: u64) -> io::Result<String> {
    if !std::fs::metadata(path)?.is_file() {
        return Err(io::Error::other("it is no file"));
    }
    read_within(path, most)
}

/// Reads a file or pipe of at most `most` bytes. The limit also stops the reading of endless
/// devices.
pub(super) fn read_within(path: &Path, most: u64) -> io::Result<String> {
    let mut bytes = Vec::new();
    File::open(path)?.take(most.saturating_add(1)).read_to_end(&mut bytes)?;
    let is_longer = bytes.len() as u64 > most;
    match text_of(bytes) {
        Err(error @ NotText::OfKind { .. }) => Err(no_scene(error)),
        _ if is_longer => Err(io::Error::other(format!("it is longer than {most} bytes"))),
        read => read.map_err(no_scene),
    }
}

fn no_scene(error: NotText) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, format!("it is not a scene file: {error}"))
}

/// Pairs of fields that state the same thing in two ways.
const SAME: [(&str, &str); 2] = [("rotation", "look_at"), ("look_at", "rotation")];

/// Merges table `upper` into `lower`: lists of elements are appended, tables are merged, and other
/// values are replaced.
pub(super) fn lay_over(lower: &mut Table, upper: Table) {
    for (one, other) in SAME {
        if upper.contains_key(one) {
            lower.remove(other);
        }
    }
    for (field, value) in upper {
        match (lower.get_mut(&field), value) {
            (Some(Value::Array(list)), Value::Array(more)) if is_list(&field) => list.extend(more),
            (Some(Value::Table(inner)), Value::Table(over)) => lay_over(inner, over),
            (Some(place), value) => *place = value,
            (None, value) => _ = lower.insert(field, value),
        }
    }
}
