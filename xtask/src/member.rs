//! The crates of the workspace, from cargo's metadata.

use std::collections::BTreeSet;
use std::path::PathBuf;

use serde_json::Value;

use crate::shell::{Outcome, metadata};

/// A crate of the workspace.
#[derive(Debug, Clone)]
pub struct Member {
    pub name: String,
    pub version: String,
    /// Folder of its `Cargo.toml`.
    pub folder: PathBuf,
    /// Whether it may be published.
    pub is_published: bool,
    /// The other members that it depends on.
    pub uses: Vec<Use>,
    /// Metadata of the package from cargo.
    pub described: Value,
}

/// A dependency of a member on another one.
#[derive(Debug, Clone)]
pub struct Use {
    pub name: String,
    /// Accepted versions, for example `^1.0`.
    pub versions: String,
    /// Whether it is only a dependency of tests.
    pub is_for_tests: bool,
}

/// Returns all members of the workspace by name.
pub fn all() -> Outcome<Vec<Member>> {
    let described = metadata(&["--no-deps"])?;
    let packages = described["packages"].as_array().ok_or("cargo metadata lists no packages")?;
    let mut members: Vec<Member> = packages.iter().map(member).collect();
    members.sort_by(|a, b| a.name.cmp(&b.name));
    Ok(members)
}

/// Returns the members that may be published, each after its dependencies.
pub fn in_order_of_publishing(members: &[Member]) -> Outcome<Vec<&Member>> {
    let mut ahead: Vec<&Member> = members.iter().filter(|it| it.is_published).collect();
    let mut done: BTreeSet<&str> = BTreeSet::new();
    let mut order = Vec::new();
    while !ahead.is_empty() {
        let is_next = |it: &&Member| it.uses.iter().all(|used| done.contains(used.name.as_str()));
        let (next, rest): (Vec<_>, Vec<_>) = ahead.into_iter().partition(is_next);
        if next.is_empty() {
            let names: Vec<&str> = rest.iter().map(|it| it.name.as_str()).collect();
            return Err(format!(
                "{} use each other, or a crate that is not published",
                names.join(", ")
            ));
        }
        done.extend(next.iter().map(|it| it.name.as_str()));
        order.extend(next);
        ahead = rest;
    }
    Ok(order)
}

/// Returns the members that a member is built from, including itself.
pub fn built_from<'a>(members: &'a [Member], name: &str) -> Vec<&'a Member> {
    let mut found: BTreeSet<&str> = BTreeSet::new();
    let mut ahead = vec![name];
    while let Some(name) = ahead.pop() {
        let member = members.iter().find(|it| it.name == name);
        if let Some(member) = member.filter(|it| found.insert(&it.name)) {
            let uses = member.uses.iter().filter(|used| !used.is_for_tests);
            ahead.extend(uses.map(|used| used.name.as_str()));
        }
    }
    members.iter().filter(|it| found.contains(it.name.as_str())).collect()
}

fn member(package: &Value) -> Member {
    let manifest = PathBuf::from(text(&package["manifest_path"]));
    let dependencies = package["dependencies"].as_array().into_iter().flatten();
    // Dependencies in the workspace have a path.
    let own = dependencies.filter(|dependency| dependency["path"].is_string());
    let uses = own.map(|dependency| Use {
        name: text(&dependency["name"]),
        versions: text(&dependency["req"]),
        is_for_tests: dependency["kind"] == "dev",
    });
    Member {
        name: text(&package["name"]),
        version: text(&package["version"]),
        folder: manifest.parent().map(PathBuf::from).unwrap_or_default(),
        // An empty list of registries means none; no list means any.
        is_published: package["publish"].is_null(),
        uses: uses.collect(),
        described: package.clone(),
    }
}

fn text(value: &Value) -> String {
    value.as_str().unwrap_or_default().to_owned()
}

/// Returns a crate with dependencies, for tests.
#[cfg(test)]
pub fn crate_of(name: &str, is_published: bool, uses: &[&str]) -> Member {
    let used = |name: &&str| Use {
        name: (*name).to_owned(),
        versions: "^1.0.0".to_owned(),
        is_for_tests: false,
    };
    Member {
        name: name.to_owned(),
        version: "1.0.0".to_owned(),
        folder: "crates".into(),
        is_published,
        uses: uses.iter().map(used).collect(),
        described: Value::Null,
    }
}

#[cfg(test)]
mod tests {
    use super::{Member, built_from, crate_of, in_order_of_publishing};

    fn names(members: &[&Member]) -> Vec<String> {
        members.iter().map(|it| it.name.clone()).collect()
    }

    #[test]
    fn each_crate_is_published_after_those_that_it_uses() {
        let members = [
            crate_of("a", true, &["b", "c"]),
            crate_of("b", true, &["c"]),
            crate_of("c", true, &[]),
            crate_of("d", false, &["a"]),
        ];
        assert_eq!(names(&in_order_of_publishing(&members).unwrap()), ["c", "b", "a"]);
        assert_eq!(names(&built_from(&members, "b")), ["b", "c"]);
    }

    #[test]
    fn crates_in_a_circle_or_on_a_private_one_have_no_order() {
        let circle = [crate_of("a", true, &["b"]), crate_of("b", true, &["a"])];
        assert!(in_order_of_publishing(&circle).is_err());
        let private = [crate_of("a", true, &["b"]), crate_of("b", false, &[])];
        assert!(in_order_of_publishing(&private).is_err());
    }
}
