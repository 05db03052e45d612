//! What the native engine makes of the built-in scenes: the bits that every other build must have.

use std::fs;

use crate::shell::Outcome;

/// The state hashes after ten seconds that a test of `carom-scene` holds the native engine to.
const PINNED: &str = "crates/carom-scene/tests/state_hashes.txt";

/// Names of the built-in scenes, each with its state hash under its own rule after 10 s.
pub fn pinned() -> Outcome<Vec<(String, String)>> {
    let pinned = fs::read_to_string(PINNED).map_err(|error| format!("{PINNED}: {error}"))?;
    let own = pinned.lines().filter_map(|line| line.split_once(".toml "));
    // Those under another rule name it.
    let own = own.filter(|(_, hash)| !hash.contains(' '));
    Ok(own.map(|(scene, hash)| (scene.to_owned(), hash.to_owned())).collect())
}

/// The state hashes of [`pinned`], as a JSON object.
pub fn json() -> Outcome<String> {
    let row = |(scene, hash): (String, String)| format!("  \"{scene}\": \"{hash}\"");
    let rows: Vec<String> = pinned()?.into_iter().map(row).collect();
    Ok(format!("{{\n{}\n}}\n", rows.join(",\n")))
}
