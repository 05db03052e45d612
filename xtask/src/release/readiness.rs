//! Requirements for publishing a release, which a dry run does not need.

use super::versions::{VERSION, is_in_changelog};
use crate::documents;
use crate::member;
use crate::shell::Outcome;

/// The host of an address that leads nowhere ends in this.
const RESERVED: &str = ".example";
/// Files that users read away from the repository, and that contain its address.
const NAME_THE_ADDRESS: [&str; 3] = ["CITATION.cff", "pyproject.toml", "web/package/package.json"];

/// Returns what is missing. `tag` is the name of the release in Git, if it has one.
pub fn open_points(tag: Option<&str>) -> Outcome<Vec<String>> {
    let mut open = Vec::new();
    if let Some(tag) = tag.filter(|tag| *tag != format!("v{VERSION}")) {
        open.push(format!("  the tag is {tag}, and the version {VERSION}"));
    }
    let address = address()?;
    if host(&address).ends_with(RESERVED) {
        open.push(format!("  `repository` of Cargo.toml is {address}, which leads nowhere"));
    } else {
        for file in NAME_THE_ADDRESS {
            if !documents::text(file)?.contains(&address) {
                open.push(format!("  {file} does not name {address}"));
            }
        }
    }
    if !is_in_changelog(&documents::text("CHANGELOG.md")?, VERSION) {
        open.push(format!("  CHANGELOG.md has no heading `## {VERSION}`"));
    }
    Ok(open)
}

/// Returns the address of the repository.
fn address() -> Outcome<String> {
    let engine = member::all()?.into_iter().find(|it| it.name == "carom");
    let address = engine.and_then(|it| Some(it.described["repository"].as_str()?.to_owned()));
    address.ok_or_else(|| "the crate carom names no repository".to_owned())
}

fn host(address: &str) -> &str {
    let rest = address.split_once("://").map_or(address, |(_, rest)| rest);
    rest.split('/').next().unwrap_or(rest)
}

#[cfg(test)]
mod tests {
    use super::{RESERVED, host};

    #[test]
    fn addresses_that_are_reserved_are_known_by_their_host() {
        assert!(host("https://carom.example/carom").ends_with(RESERVED));
        assert!(!host("https://github.com/x/y.example").ends_with(RESERVED));
    }
}
