//! The crates that registries get: what they say of themselves, and what their packages hold.

use std::fs;

use serde_json::Value;

use super::{archive, files};
use crate::member::{Member, all, built_from, in_order_of_publishing};
use crate::setup;
use crate::shell::{Outcome, cargo_with, target_folder};

/// What crates.io takes at most \[bytes\].
const LARGEST: u64 = 10 * 1024 * 1024;
/// Words to find a crate by that crates.io takes at most.
const KEYWORDS: usize = 5;
/// What draws: crates that use it take minutes to compile.
const RENDERER: &str = "carom-render";
/// What each package holds besides its sources.
const HELD: [&str; 5] =
    ["Cargo.toml", "LICENSE-APACHE", "LICENSE-MIT", "README.md", "Cargo.toml.orig"];

/// Refuses crates that registries would take without a description, and those that have no order.
pub fn check(members: &[Member]) -> Outcome {
    let mut faults = Vec::new();
    for member in in_order_of_publishing(members)? {
        faults.extend(faults_of(member));
    }
    if faults.is_empty() { Ok(()) } else { Err(format!("crates:\n{}", faults.join("\n"))) }
}

/// Packs all crates, and compiles from their packages those that draw nothing, or all.
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

/// Packs crates together: those that are not in the registry yet find each other.
fn package(members: &[&Member], options: &[&str]) -> Outcome {
    let mut arguments = vec!["package", "--quiet", "--allow-dirty"];
    arguments.extend(options);
    for member in members {
        arguments.extend(["--package", &member.name]);
    }
    // What is compiled here is thrown away.
    cargo_with(&arguments, &[("CARGO_PROFILE_DEV_DEBUG", "false")])
}

/// What a crate does not say of itself.
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
