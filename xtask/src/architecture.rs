//! Keeps the list of crates in `ARCHITECTURE.md` complete.

use std::collections::BTreeSet;

use crate::documents;
use crate::shell::{Outcome, root};

/// Compares the table of crates with the folders that hold a `Cargo.toml`.
pub fn check() -> Outcome {
    let text = documents::text("ARCHITECTURE.md")?;
    let listed: BTreeSet<String> = text
        .lines()
        .filter_map(|line| line.strip_prefix("| `")?.split_once("` |"))
        .map(|(name, _)| name.to_owned())
        .filter(|name| name == "xtask" || name.starts_with("crates/"))
        .collect();
    let mut existing = BTreeSet::from(["xtask".to_owned()]);
    let folder = root().join("crates");
    let entries = std::fs::read_dir(&folder).map_err(|error| error.to_string())?;
    for entry in entries {
        let path = entry.map_err(|error| error.to_string())?.path();
        if path.join("Cargo.toml").exists() {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            existing.insert(format!("crates/{name}"));
        }
    }
    if listed == existing {
        return Ok(());
    }
    Err(format!("ARCHITECTURE.md lists the crates {listed:?}, but there are {existing:?}"))
}
