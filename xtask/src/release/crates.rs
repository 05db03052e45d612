//! The published crates: their metadata, and the content of their packages.

use std::fs;

use serde_json::Value;

use super::{archive, files};
use crate::member::{Member, all, built_from, in_order_of_publishing};
use crate::setup;
use crate::shell::{Outcome, cargo_with, target_folder};

/// Largest package that crates.io accepts \[bytes\].
const LARGEST: u64 = 10 * 1024 * 1024;
/// Largest number of keywords that crates.io accepts.
const KEYWORDS: usize = 5;
/// The crate that draws; crates that use it take minutes to compile.
const RENDERER: &str = "carom-render";
/// Files in each package besides sources.
const HELD: [&str; 5] =
    ["Cargo.toml", "LICENSE-APACHE", "LICENSE-MIT", "README.md", "Cargo.toml.orig"];

/// Checks the metadata of crates that registries would accept without, and that they have an order.
pub fn check(members: &[Member]) -> Outcome {
    let mut faults = Vec::new();
    for member in in_order_of_publishing(members)? {
        faults.extend(faults_of(member));
    }
    if faults.is_empty() { Ok(()) } else { Err(format!("crates:\n{}", faults.join("\n"))) }
}

/// Packs all crates, and compiles those that do not draw, or all, from their packages.
pub fn make(verifies_all: bool) -> Outcome {
    let members = all()?;
    let order = in_order_of_publishing(&members)?;
    let draws = |it: &Member| built_from(&members, &it.name).iter().any(|it| it.name == RENDERER);
    if verifies_all {
        setup::graphics()?;
    }
    package(&order, &["--no-verify"])?;
    let verified: Vec<&Member> =
        order.iter().copied().filter(|it| verifies_all || !draws(it)).collect();
    package(&verified, &[])?;
    for member in order {
        let name = format!("{}-{}.crate", member.name, member.version);
        let file = files::publish(&target_folder().join("package").join(&name))?;
        archive::demand(&file, &HELD)?;
        let bytes = fs::metadata(&file).map_err(|error| format!("{name}: {error}"))?.len();
        if bytes > LARGEST {
            return Err(format!("{name} has {bytes} bytes; crates.io takes {LARGEST}"));
        }
    }
    Ok(())
}

/// Packs crates together, so that unpublished ones find each other.
fn package(members: &[&Member], options: &[&str]) -> Outcome {
    let mut arguments = vec!["package", "--quiet", "--allow-dirty"];
    arguments.extend(options);
    for member in members {
        arguments.extend(["--package", &member.name]);
    }
    // The output of this compilation is not kept.
    cargo_with(&arguments, &[("CARGO_PROFILE_DEV_DEBUG", "false")])
}

/// Returns the missing metadata of a crate.
fn faults_of(member: &Member) -> Vec<String> {
    let described = &member.described;
    let has_text = |field: &str| described[field].as_str().is_some_and(|text| !text.is_empty());
    let count = |field: &str| described[field].as_array().map_or(0, Vec::len);
    let mut missing: Vec<&str> = ["description", "license", "repository", "readme"]
        .into_iter()
        .filter(|field| !has_text(field))
        .collect();
    if !(1..=KEYWORDS).contains(&count("keywords")) {
        missing.push("one to five keywords");
    }
    if count("categories") == 0 {
        missing.push("categories");
    }
    if !matches!(described["metadata"]["docs"]["rs"], Value::Object(_)) {
        missing.push("package.metadata.docs.rs");
    }
    missing.iter().map(|field| format!("  {} needs {field}", member.name)).collect()
}
