//! Checks that every crate comes from the registry and has a free licence.

use serde_json::Value;
use spdx::{Expression, ParseMode};

use crate::shell::{Outcome, metadata};

/// Licences that allow everyone to use, change and distribute a product that contains the crate.
const LICENCES: [&str; 13] = [
    "0BSD",
    "Apache-2.0",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "BSL-1.0",
    "ISC",
    "MIT",
    "MPL-2.0",
    "OFL-1.1",
    "Ubuntu-font-1.0",
    "Unicode-3.0",
    "Unlicense",
    "Zlib",
];

/// The only allowed source of crates.
const REGISTRY: &str = "registry+https://github.com/rust-lang/crates.io-index";

/// Checks the crates in `Cargo.lock`.
pub fn check() -> Outcome {
    let mut faults = Vec::new();
    for package in packages()? {
        let text = |field: &str| package[field].as_str().unwrap_or_default().to_owned();
        let (name, version) = (text("name"), text("version"));
        // Crates of the workspace have no source.
        let source = package["source"].as_str().unwrap_or(REGISTRY);
        if source != REGISTRY {
            faults.push(format!("{name} {version} comes from {source}"));
        }
        if !is_free(&text("license")) {
            faults.push(format!("{name} {version} has the licence {:?}", text("license")));
        }
    }
    if faults.is_empty() { Ok(()) } else { Err(faults.join("\n")) }
}

/// Returns the metadata of every crate in the lock file.
fn packages() -> Outcome<Vec<Value>> {
    let packages = metadata(&[])?["packages"].as_array().cloned();
    packages.ok_or_else(|| "cargo metadata lists no packages".into())
}

/// Returns whether an SPDX licence expression allows a free licence.
fn is_free(licence: &str) -> bool {
    let expression = Expression::parse_mode(licence, ParseMode::LAX);
    expression.is_ok_and(|it| {
        it.evaluate(|choice| choice.license.id().is_some_and(|id| LICENCES.contains(&id.name)))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_free_choice_is_enough_and_each_part_needs_one() {
        for free in
            ["MIT", "MIT/Apache-2.0", "GPL-2.0-only OR MIT", "(MIT OR Apache-2.0) AND Unicode-3.0"]
        {
            assert!(is_free(free), "{free}");
        }
        for bound in ["", "GPL-3.0-only", "MIT AND LGPL-2.1-or-later", "no licence"] {
            assert!(!is_free(bound), "{bound}");
        }
    }
}
