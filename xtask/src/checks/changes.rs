//! What a change reaches: the packages that hold changed files, and those that depend on them.

use std::collections::BTreeSet;

use super::part::{Part, Reads};
use crate::member::{self, Member};
use crate::shell::{Outcome, output};

/// Files that every package is built with, or checked by.
const OF_ALL: [&str; 4] = ["Cargo.toml", "Cargo.lock", ".cargo/", "xtask/"];

/// Files that have changed, and packages that this can reach.
#[derive(Debug)]
pub struct Changes {
    files: Vec<String>,
    /// Whether what has changed can reach everything.
    is_of_all: bool,
    packages: BTreeSet<String>,
}

impl Changes {
    /// Returns the changes since the last commit that the branch on the server has, or since
    /// `base`: committed, not committed and new files.
    pub fn since(base: Option<&str>) -> Outcome<Self> {
        let upstream = output("git", &["merge-base", "HEAD", "origin/HEAD"]);
        let base = match (base, &upstream) {
            (Some(base), _) => base,
            (None, Some(commit)) => commit.trim(),
            (None, None) => "HEAD",
        };
        let changed = output("git", &["diff", "--name-only", base]);
        let changed = changed.ok_or_else(|| format!("git knows no commit {base}"))?;
        let new = output("git", &["ls-files", "--others", "--exclude-standard"]);
        let files = changed.lines().chain(new.as_deref().unwrap_or_default().lines());
        Ok(Self::new(files.map(str::to_owned).collect(), &member::all()?))
    }

    /// Changes of files, and all that members of the workspace make of them.
    fn new(files: Vec<String>, members: &[Member]) -> Self {
        let starts = |file: &String| OF_ALL.iter().any(|it| file.starts_with(it));
        let is_of_all = files.iter().any(starts);
        let mut packages: BTreeSet<String> = files.iter().filter_map(|it| package(it)).collect();
        loop {
            let is_reached = |it: &&Member| it.uses.iter().any(|it| packages.contains(&it.name));
            let more: Vec<String> = members
                .iter()
                .filter(|it| !packages.contains(&it.name))
                .filter(is_reached)
                .map(|it| it.name.clone())
                .collect();
            if more.is_empty() {
                return Self { files, is_of_all, packages };
            }
            packages.extend(more);
        }
    }

    /// Whether the outcome of a part can be another one.
    pub fn reach(&self, part: &Part) -> bool {
        match part.reads {
            Reads::Everything => !self.files.is_empty(),
            Reads::Some { packages, paths } => {
                self.is_of_all
                    || packages.iter().any(|name| self.packages.contains(*name))
                    || self.files.iter().any(|file| paths.iter().any(|it| file.starts_with(it)))
            }
        }
    }

    /// The packages that are reached, with commas between them; none where that is every package.
    pub fn packages(&self) -> Option<String> {
        let names: Vec<&str> = self.packages.iter().map(String::as_str).collect();
        (!self.is_of_all).then(|| names.join(","))
    }
}

/// The package that holds a file.
fn package(file: &str) -> Option<String> {
    let mut folders = file.strip_prefix("crates/")?.split('/');
    folders.next().map(str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::{Changes, Part, Reads};
    use crate::member::crate_of;

    fn changes(files: &[&str]) -> Changes {
        let members = [
            crate_of("carom-scene", true, &["carom", "serde"]),
            crate_of("carom-view", true, &["carom-scene"]),
            crate_of("carom-analysis", true, &[]),
        ];
        Changes::new(files.iter().map(|it| (*it).to_owned()).collect(), &members)
    }

    fn part(reads: Reads) -> Part {
        Part { name: "a", after: &[], reads, run: || Ok(()) }
    }

    #[test]
    fn a_change_reaches_what_depends_on_it_and_nothing_else() {
        let view = part(Reads::Some { packages: &["carom-view"], paths: &["web/"] });
        let pairs = part(Reads::Some { packages: &["carom-analysis"], paths: &[] });
        let physics = changes(&["crates/carom/src/lib.rs"]);
        assert!(physics.reach(&view) && !physics.reach(&pairs));
        assert_eq!(physics.packages().as_deref(), Some("carom,carom-scene,carom-view"));
        assert!(changes(&["crates/carom-scene/scenes/a.toml"]).reach(&view));
        assert!(changes(&["web/serve.js"]).reach(&view));
        assert!(!changes(&["docs/a.md"]).reach(&view));
        assert!(changes(&["docs/a.md"]).reach(&part(Reads::Everything)));
        let all = changes(&["Cargo.lock"]);
        assert!(all.reach(&pairs) && all.packages().is_none());
    }
}
