//! The sources in Python, JavaScript and C#: which there are, and what stands in them.

mod code;
pub mod csharp;
pub mod functions;
pub mod javascript;
mod language;
pub mod python;
mod script;

use std::fs;
use std::path::Path;

use crate::files::said;
use crate::shell::{Outcome, root};
use crate::sources::{read, seen_from_root};

pub use language::Language;
pub use script::Script;

/// The folders that hold them.
const PLACES: [&str; 4] = ["bench", "crates/carom-c", "python", "web"];
/// Folders of what others wrote, or programs made.
const FOREIGN: [&str; 6] = ["__pycache__", "built", "dist", "module", "node_modules", "target"];

/// All of them, in the order of their files.
pub fn scripts() -> Outcome<Vec<Script>> {
    let mut found = Vec::new();
    for place in PLACES {
        add_from(&root().join(place), &mut found)?;
    }
    found.sort_by(|one, other| one.file.cmp(&other.file));
    Ok(found)
}

fn add_from(folder: &Path, found: &mut Vec<Script>) -> Outcome {
    for entry in fs::read_dir(folder).map_err(|error| said(folder, &error))? {
        let path = entry.map_err(|error| said(folder, &error))?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if path.is_dir() {
            if !FOREIGN.contains(&name.as_ref()) && !name.starts_with('.') {
                add_from(&path, found)?;
            }
        } else if let Some(language) = Language::of(&path) {
            let file = seen_from_root(&path).to_owned();
            found.push(Script { file, language, text: read(&path)? });
        }
    }
    Ok(())
}
