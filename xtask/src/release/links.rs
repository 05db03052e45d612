//! Checks links and embedded files of published crates and packages.
//!
//! docs.rs shows no files of the repository, registries show only READMEs, and a package contains
//! only the folder of its crate.

use std::path::Path;

use crate::files::normal;
use crate::markdown::Markdown;
use crate::member::Member;
use crate::shell::{Outcome, root};
use crate::sources::{files_of, read, seen_from_root};

/// READMEs of packages that are not crates.
const READMES: [&str; 2] = ["python/README.md", "web/package/README.md"];
/// Extensions of files that links may lead to.
const ENDINGS: [&str; 6] = [".md", ".rs", ".toml", ".png", ".html", ".ipynb"];
/// Macros that embed files into the compiled code.
const MACROS: [&str; 2] = ["include_str!(", "include_bytes!("];

/// Reports links and embedded files that are not in the package.
pub fn check(members: &[Member]) -> Outcome {
    let mut faults = Vec::new();
    for member in members.iter().filter(|it| it.is_published) {
        for file in files_of(&member.folder.join("src"))? {
            let text = read(&file)?;
            let mut found = relative_links(&documentation(&text));
            found.extend(outside(&text, &file, &member.folder));
            faults.extend(found.iter().map(|spot| fault(&file, spot)));
        }
        let readme = member.folder.join("README.md");
        let mut links = relative_links(&read(&readme)?);
        links.retain(|(_, link)| link.contains("..") || !member.folder.join(link).is_file());
        faults.extend(links.iter().map(|spot| fault(&readme, spot)));
    }
    for file in READMES.map(|file| root().join(file)) {
        let links = relative_links(&read(&file)?);
        faults.extend(links.iter().map(|spot| fault(&file, spot)));
    }
    if faults.is_empty() {
        return Ok(());
    }
    Err(format!("packages do not hold what they refer to:\n{}", faults.join("\n")))
}

fn fault(file: &Path, (line, what): &(usize, String)) -> String {
    format!("  {}:{line}: {what}", seen_from_root(file).display())
}

/// Returns the documentation of a source, with lines in their places.
fn documentation(source: &str) -> String {
    let lines = source.lines().map(|line| {
        let line = line.trim_start();
        line.strip_prefix("///").or_else(|| line.strip_prefix("//!")).unwrap_or_default().trim()
    });
    lines.collect::<Vec<_>>().join("\n")
}

/// Returns links of a document to files, with their lines. Addresses and names of types are not
/// files.
fn relative_links(text: &str) -> Vec<(usize, String)> {
    let inline = Markdown::parse(text).links.into_iter().map(|link| (link.line, link.text));
    let referred = text.lines().enumerate().filter_map(|(number, line)| {
        let (_, target) = line.strip_prefix('[')?.split_once("]: ")?;
        Some((number + 1, target.trim().to_owned()))
    });
    inline.chain(referred).filter(|(_, link)| is_file(link)).collect()
}

fn is_file(link: &str) -> bool {
    let path = link.split('#').next().unwrap_or(link);
    let is_address = link.contains("://") || link.starts_with("mailto:");
    let has_ending = ENDINGS.iter().any(|ending| path.ends_with(ending));
    !is_address && (path.contains('/') || has_ending || path.starts_with("LICENSE"))
}

/// Returns embedded files outside of a folder, with their lines.
fn outside(source: &str, file: &Path, folder: &Path) -> Vec<(usize, String)> {
    let calls = MACROS.iter().flat_map(|name| source.match_indices(*name));
    let found = calls.filter_map(|(at, name)| {
        // The path, or its start if it is composed.
        let path = source[at + name.len()..].split('"').nth(1)?;
        let line = source[..at].matches('\n').count() + 1;
        let is_outside = !normal(&file.parent()?.join(path)).starts_with(folder);
        is_outside.then(|| (line, path.to_owned()))
    });
    found.collect()
}

#[cfg(test)]
mod tests {
    use super::{documentation, outside, relative_links};

    fn links(source: &str) -> Vec<(usize, String)> {
        relative_links(&documentation(source))
    }

    #[test]
    fn links_to_files_are_found_in_documentation() {
        let source = "//! See [a](docs/a.md#b).\n\n/// [c]: ../c.html\nfn f() {} // [d](d.md)\n";
        let found = [(1, "docs/a.md#b"), (3, "../c.html")];
        assert_eq!(links(source), found.map(|(line, link)| (line, link.to_owned())));
    }

    #[test]
    fn addresses_and_names_of_types_are_no_files() {
        let source = "/// [a](https://x.y/z.md), [b](crate::World::step), [c](#heading), [`World`]\n\
                      /// ```\n/// let x = y[0](z.md);\n/// ```\n";
        assert!(links(source).is_empty(), "{:?}", links(source));
    }

    #[test]
    fn embedded_files_lie_in_the_folder_of_the_crate() {
        let source = "include_str!(\"a.txt\");\ninclude_bytes!(\"../b\");\n\
                      include_str!(concat!(\"../../scenes/\", $file))";
        let found = outside(source, "/w/crate/src/lib.rs".as_ref(), "/w/crate".as_ref());
        assert_eq!(found, [(3, "../../scenes/".to_owned())]);
    }
}
