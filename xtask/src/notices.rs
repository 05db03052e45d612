//! Collects the licences of crates in a compiled program or library, for those who receive it.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::shell::{Outcome, metadata};

/// Name of the file in archives.
pub const FILE: &str = "THIRD-PARTY-NOTICES.txt";

/// First words of the names of licence files, in capitals.
const BEGINNINGS: [&str; 8] =
    ["LICENSE", "LICENCE", "COPYING", "COPYRIGHT", "NOTICE", "UNLICENSE", "OFL", "UFL"];

/// Returns the dependencies of a workspace crate for a target, with the text of each licence.
/// Features that other members request are included, so the list may be too long but never too
/// short.
pub fn of(member: &str, target: &str) -> Outcome<String> {
    let described = metadata(&["--filter-platform", target])?;
    let used = used_by(member, &described);
    let packages = described["packages"].as_array().into_iter().flatten();
    let mut list = String::new();
    let mut texts: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for package in packages.filter(|it| !it["source"].is_null() && used.contains(text(&it["id"]))) {
        let name = format!("{} {}", text(&package["name"]), text(&package["version"]));
        list += &format!("{name}: {}\n", text(&package["license"]));
        for file in licences_in(Path::new(text(&package["manifest_path"])).parent()) {
            let licence =
                fs::read(&file).map_err(|error| format!("{}: {error}", file.display()))?;
            let licence = String::from_utf8_lossy(&licence).replace("\r\n", "\n");
            texts.entry(licence.trim().to_owned()).or_default().push(name.clone());
        }
    }
    let mut whole =
        format!("{member} contains code of these crates, under these licences:\n\n{list}");
    for (licence, names) in texts {
        let rule = "-".repeat(80);
        whole += &format!("\n{rule}\n{}\n{rule}\n\n{licence}\n", names.join(", "));
    }
    Ok(whole)
}

/// Returns the ids of all packages that are compiled into a workspace crate.
fn used_by<'a>(member: &str, described: &'a Value) -> BTreeSet<&'a str> {
    let packages = described["packages"].as_array().into_iter().flatten();
    let own = packages.filter(|it| it["name"] == *member && it["source"].is_null());
    let mut ahead: Vec<&str> = own.map(|it| text(&it["id"])).collect();
    let nodes = described["resolve"]["nodes"].as_array().into_iter().flatten();
    let nodes: BTreeMap<&str, &Value> = nodes.map(|node| (text(&node["id"]), node)).collect();
    let mut used = BTreeSet::new();
    while let Some(id) = ahead.pop() {
        if !used.insert(id) {
            continue;
        }
        let dependencies = nodes.get(id).and_then(|node| node["deps"].as_array());
        let dependencies = dependencies.into_iter().flatten().filter(|it| is_compiled_in(it));
        ahead.extend(dependencies.map(|it| text(&it["pkg"])));
    }
    used
}

/// Returns whether a dependency is compiled in, not only used by tests or build scripts.
fn is_compiled_in(dependency: &Value) -> bool {
    let kinds = dependency["dep_kinds"].as_array();
    kinds.is_some_and(|kinds| kinds.iter().any(|kind| kind["kind"].is_null()))
}

/// Returns the licence files in a folder and its subfolders.
fn licences_in(folder: Option<&Path>) -> Vec<PathBuf> {
    let entries = |folder: &Path| -> Vec<PathBuf> {
        let entries = fs::read_dir(folder).into_iter().flatten();
        entries.filter_map(|entry| Some(entry.ok()?.path())).collect()
    };
    let own = folder.map(entries).unwrap_or_default();
    let inner: Vec<PathBuf> =
        own.iter().filter(|path| path.is_dir()).flat_map(|it| entries(it)).collect();
    let mut files: Vec<PathBuf> = own.into_iter().chain(inner).collect();
    files.retain(|path| {
        let name = path.file_name().unwrap_or_default().to_string_lossy().to_uppercase();
        path.is_file() && BEGINNINGS.iter().any(|beginning| name.starts_with(beginning))
    });
    files.sort();
    files
}

fn text(value: &Value) -> &str {
    value.as_str().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::of;
    use crate::shell::host;

    #[test]
    fn what_is_compiled_in_is_listed_and_what_tests_use_is_not() {
        let notices = of("carom-c", &host().unwrap()).unwrap();
        let lists = |name: &str| notices.lines().any(|line| line.starts_with(&format!("{name} ")));
        assert!(lists("glam") && lists("libm") && lists("toml"), "{notices}");
        assert!(!lists("cbindgen") && !lists("carom"), "{notices}");
        assert!(notices.contains("Permission is hereby granted"), "{notices}");
    }
}
