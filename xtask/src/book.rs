//! The documents as one site with a search.
//!
//! Pages are copied as they lie in the repository, so links between them stay as they are. Links to other files lead
//! to the address of the repository.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Command;

use crate::documents;
use crate::files::{copy, emptied, made, normal, said};
use crate::shell::{Outcome, finish, root, target_folder};
use crate::tools::Tool;

const MDBOOK: Tool = Tool {
    package: "mdbook",
    program: "mdbook",
    version: "0.5.4",
    arguments: &["--no-default-features", "--features", "search"],
};
/// The list of pages.
const SUMMARY: &str = "xtask/site/SUMMARY.md";
const SETTINGS: &str = "xtask/site/book.toml";
const PICTURES: &str = "docs/pictures";
/// Where files lie that are no pages.
const FILES: &str = concat!(env!("CARGO_PKG_REPOSITORY"), "/blob/main");

/// Makes the site in the target folder.
pub fn build() -> Outcome {
    let program = MDBOOK.installed()?;
    let folder = emptied(target_folder().join("book"))?;
    let source = folder.join("src");
    let pages = pages()?;
    for page in &pages {
        write(&source.join(page), &page_of_site(&documents::text(page)?, page, &pages))?;
    }
    write(&source.join("SUMMARY.md"), &summary()?)?;
    copy(&root().join(PICTURES), &source.join(PICTURES))?;
    copy(&root().join(SETTINGS), &folder.join("book.toml"))?;
    finish("mdbook", Command::new(program).arg("build").arg(&folder))?;
    eprintln!("xtask: the site is in {}", folder.join("book").display());
    Ok(())
}

/// The documents that the summary names, as paths from the root of the repository.
fn pages() -> Outcome<BTreeSet<String>> {
    let summary = documents::read(SUMMARY)?;
    Ok(summary.links.iter().map(|link| from_root(SUMMARY, &link.text)).collect())
}

/// The summary as mdBook reads it: beside the folders of all pages.
fn summary() -> Outcome<String> {
    Ok(with_links(&documents::text(SUMMARY)?, |target| from_root(SUMMARY, target)))
}

/// A page whose links lead to pages and pictures of the site, or to the repository.
fn page_of_site(text: &str, page: &str, pages: &BTreeSet<String>) -> String {
    with_links(text, |target| {
        let path = target.split('#').next().unwrap_or_default();
        let file = from_root(page, path);
        let is_here = path.is_empty() || pages.contains(&file) || file.starts_with(PICTURES);
        if is_here || target.contains("://") {
            target.to_owned()
        } else {
            format!("{FILES}/{file}")
        }
    })
}

/// The text with other targets of its links; blocks of code stay.
fn with_links(text: &str, target: impl Fn(&str) -> String) -> String {
    let mut is_code = false;
    let mut whole = String::new();
    for line in text.lines() {
        is_code ^= line.trim_start().starts_with("```");
        let mut rest = line;
        while let Some((before, after)) = rest.split_once("](").filter(|_| !is_code) {
            let Some((old, later)) = after.split_once(')') else { break };
            whole += &format!("{before}]({})", target(old));
            rest = later;
        }
        whole += rest;
        whole.push('\n');
    }
    whole
}

/// A relative path of a document, from the root of the repository.
fn from_root(document: &str, path: &str) -> String {
    let folder = Path::new(document).parent().unwrap_or(Path::new(""));
    normal(&folder.join(path)).to_string_lossy().into_owned()
}

fn write(file: &Path, text: &str) -> Outcome {
    made(file.parent().unwrap_or(file).to_owned())?;
    fs::write(file, text).map_err(|error| said(file, &error))
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::{FILES, page_of_site};

    #[test]
    fn links_to_pages_stay_and_others_lead_to_the_repository() {
        let pages = BTreeSet::from(["docs/a.md".to_owned(), "README.md".to_owned()]);
        let text = "[a](a.md#x) [r](../README.md) ![p](pictures/p.png) [c](../crates/c.rs) [w](https://w.w) [h](#h)\n\
                    ```\n[c](../crates/c.rs)\n```\n";
        let expected = text.replacen("../crates/c.rs", &format!("{FILES}/crates/c.rs"), 1);
        assert_eq!(page_of_site(text, "docs/b.md", &pages), expected);
    }
}
