//! Checks that crates, Python package, JavaScript package and citation have the same version.

use crate::documents;
use crate::member::Member;
use crate::shell::Outcome;

/// The version of this release.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Files with a line that contains the version: the text before it, and after it.
const LINES: [(&str, &str, &str); 2] =
    [("web/package/package.json", "  \"version\": \"", "\","), ("CITATION.cff", "version: ", "")];

/// Reports versions that differ.
pub fn check(members: &[Member]) -> Outcome {
    let mut faults: Vec<String> = members.iter().flat_map(faults_of).collect();
    for (file, before, after) in LINES {
        let line = format!("{before}{VERSION}{after}");
        if !documents::text(file)?.lines().any(|it| it == line) {
            faults.push(format!("  {file} has no line {line:?}"));
        }
    }
    if !takes_version_of_crate(&documents::text("pyproject.toml")?) {
        faults.push("  pyproject.toml must take its version from the crate: dynamic".to_owned());
    }
    if faults.is_empty() { Ok(()) } else { Err(format!("versions:\n{}", faults.join("\n"))) }
}

/// Returns whether the changelog has a heading for a version.
pub fn is_in_changelog(text: &str, version: &str) -> bool {
    text.lines().filter_map(|line| line.strip_prefix("## ")).any(|heading| {
        heading.split(|letter: char| " [],(".contains(letter)).any(|word| word == version)
    })
}

fn faults_of(member: &Member) -> Vec<String> {
    let mut faults = Vec::new();
    if member.version != VERSION {
        faults.push(format!("  {} has version {}, not {VERSION}", member.name, member.version));
    }
    let wanted = format!("^{VERSION}");
    for used in member.uses.iter().filter(|_| member.is_published) {
        if used.versions != wanted {
            let (name, used, versions) = (&member.name, &used.name, &used.versions);
            faults.push(format!("  {name} uses {used} {versions}, not {wanted}"));
        }
    }
    faults
}

/// Returns whether a `pyproject.toml` takes the version from the crate.
fn takes_version_of_crate(text: &str) -> bool {
    let project = text.split("\n[project]\n").nth(1).unwrap_or_default();
    let project = project.split("\n[").next().unwrap_or_default();
    let is_own = |line: &str| line.starts_with("version");
    project.lines().any(|line| line == "dynamic = [\"version\"]") && !project.lines().any(is_own)
}

#[cfg(test)]
mod tests {
    use super::{is_in_changelog, takes_version_of_crate};

    #[test]
    fn a_version_has_a_heading_of_its_own() {
        let text = "# Changelog\n\n## 0.2.0 (2027-01-02)\n\n- of 0.3.0\n\n## [0.1.0]\n";
        assert!(is_in_changelog(text, "0.2.0") && is_in_changelog(text, "0.1.0"));
        assert!(!is_in_changelog(text, "0.3.0") && !is_in_changelog(text, "2.0"));
    }

    #[test]
    fn the_python_package_has_no_version_of_its_own() {
        let dynamic =
            "[build-system]\n\n[project]\nname = \"x\"\ndynamic = [\"version\"]\n\n[tool]\n";
        assert!(takes_version_of_crate(dynamic));
        assert!(!takes_version_of_crate("\n[project]\nversion = \"1\"\n"));
        assert!(!takes_version_of_crate("\n[tool]\ndynamic = [\"version\"]\n"));
    }
}
