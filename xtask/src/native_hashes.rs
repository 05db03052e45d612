//! State hashes of the built-in scenes in the native engine, which every other build must
//! reproduce.

use std::fs;

use crate::shell::Outcome;

/// State hashes after ten seconds, which a test of `carom-scene` checks for the native engine.
const PINNED: &str = "crates/carom-scene/tests/state_hashes.txt";

/// Returns the names of the built-in scenes, each with its state hash under its own rule after 10
/// s.
pub fn pinned() -> Outcome<Vec<(String, String)>> {
    let pinned = fs::read_to_string(PINNED).map_err(|error| format!("{PINNED}: {error}"))?;
    let own = pinned.lines().filter_map(|line| line.split_once(".toml "));
    // Hashes under another rule name that rule.
    let own = own.filter(|(_, hash)| !hash.contains(' '));
    Ok(own.map(|(scene, hash)| (scene.to_owned(), hash.to_owned())).collect())
}

/// Returns the state hashes of [`pinned`] as a JSON object.
pub fn json() -> Outcome<String> {
    let row = |(scene, hash): (String, String)| format!("  \"{scene}\": \"{hash}\"");
    let rows: Vec<String> = pinned()?.into_iter().map(row).collect();
    Ok(format!("{{\n{}\n}}\n", rows.join(",\n")))
}
