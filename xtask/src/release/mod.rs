//! `cargo xtask release`: makes and checks everything that a release publishes.
//!
//! It publishes nothing: archives are written to `target/release-files`, with their checksums. The
//! parts are independent, so that other machines can make those that differ between systems.

mod archive;
mod c_library;
mod command_line;
mod crates;
mod files;
mod javascript;
mod links;
mod readiness;
mod source_distribution;
mod table;
mod versions;
mod wheel;

use crate::member;
use crate::shell::Outcome;
use crate::wasm::Purpose;
use crate::web;

/// A part of a release, which can be made by itself.
struct Part {
    name: &'static str,
    make: fn(Options) -> Outcome,
}

/// Options for all parts.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
struct Options {
    /// Whether every crate is compiled from its package, and the wheel from the source
    /// distribution. Otherwise crates that draw are only packed.
    is_full: bool,
    /// Whether the viewer for notebooks in the Python package is kept, because another machine has
    /// built it.
    keeps_viewer: bool,
}

impl Options {
    /// Builds the viewer for notebooks into the Python package if needed, then calls `make`.
    fn with_viewer(self, make: impl FnOnce() -> Outcome) -> Outcome {
        if !self.keeps_viewer {
            web::build_for_notebooks(Purpose::Use)?;
        }
        make()
    }
}

/// All parts, those first that fail fastest.
const PARTS: [Part; 7] = [
    Part { name: "crates", make: |options| crates::make(options.is_full) },
    Part { name: "c", make: |_| c_library::make() },
    Part { name: "command", make: |_| command_line::make() },
    Part { name: "npm", make: |_| javascript::make_package() },
    Part { name: "page", make: |_| javascript::make_page() },
    Part {
        name: "sdist",
        make: |options| options.with_viewer(|| source_distribution::make(options.is_full)),
    },
    Part { name: "wheel", make: |options| options.with_viewer(wheel::make) },
];

/// Makes the parts named in `words` of the command line, by default all, and prints the table of
/// the archives.
pub fn dry_run(words: &[&str]) -> Outcome {
    let (parts, options) = chosen(words)?;
    check()?;
    if parts.len() == PARTS.len() {
        files::clear()?;
    }
    for part in parts {
        eprintln!("\n== release: {}", part.name);
        (part.make)(options)?;
    }
    files::write_checksums()?;
    table::print()
}

/// Checks what needs no build: versions, metadata of crates, links that lead out of a package.
pub fn check() -> Outcome {
    let members = member::all()?;
    versions::check(&members)?;
    crates::check(&members)?;
    links::check(&members)
}

/// Fails if the release is not ready to be published; `tag` is its name in Git.
pub fn check_readiness(tag: &str) -> Outcome {
    check()?;
    let open = readiness::open_points(Some(tag))?;
    if open.is_empty() { Ok(()) } else { Err(format!("before a release:\n{}", open.join("\n"))) }
}

/// Returns the parts and options named in words of the command line.
fn chosen(words: &[&str]) -> Outcome<(Vec<&'static Part>, Options)> {
    let (mut parts, mut options) = (Vec::new(), Options::default());
    let mut words = words.iter();
    while let Some(word) = words.next() {
        match *word {
            "--full" => options.is_full = true,
            "--keep-viewer" => options.keeps_viewer = true,
            "--part" => parts.push(part(words.next().copied().unwrap_or_default())?),
            other => return Err(format!("release --dry-run does not know {other:?}")),
        }
    }
    if parts.is_empty() {
        parts = PARTS.iter().collect();
    }
    Ok((parts, options))
}

/// Returns the part with this name.
fn part(name: &str) -> Outcome<&'static Part> {
    PARTS.iter().find(|part| part.name == name).ok_or_else(|| {
        let names: Vec<&str> = PARTS.iter().map(|part| part.name).collect();
        format!("a release has no part {name:?}; its parts are {}", names.join(", "))
    })
}

#[cfg(test)]
mod tests {
    use super::{Options, PARTS, chosen};

    #[test]
    fn options_name_parts_and_all_are_made_without() {
        let (parts, options) = chosen(&["--part", "npm", "--full", "--part", "c"]).unwrap();
        assert_eq!(parts.iter().map(|part| part.name).collect::<Vec<_>>(), ["npm", "c"]);
        assert_eq!(options, Options { is_full: true, keeps_viewer: false });
        assert_eq!(chosen(&[]).unwrap().0.len(), PARTS.len());
        for wrong in [&["--part"][..], &["--part", "wheels"], &["--dry"]] {
            assert!(chosen(wrong).is_err(), "{wrong:?}");
        }
    }
}
