//! `cargo xtask release`: makes and checks everything that a release publishes.
//!
//! Nothing is published here: archives are left in `target/release-files`, beside their checksums. The parts are
//! independent of each other, so that other machines make those that differ between systems.

mod archive;
mod c_library;
mod command_line;
mod crates;
mod files;
mod javascript;
mod links;
mod member;
mod notices;
mod readiness;
mod source_distribution;
mod table;
mod versions;
mod wheel;

use crate::shell::Outcome;

/// A part of a release, which can be made alone.
struct Part {
    name: &'static str,
    make: fn(Extent) -> Outcome,
}

/// How much of what is made is built once more from it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Extent {
    /// What draws is packed, and not compiled once more.
    Usual,
    /// Every crate is compiled from its package, and the wheel from the source distribution.
    Full,
}

impl Extent {
    fn is_full(self) -> bool {
        self == Self::Full
    }
}

/// All parts, those first that fail fastest.
const PARTS: [Part; 7] = [
    Part { name: "crates", make: |extent| crates::make(extent.is_full()) },
    Part { name: "c", make: |_| c_library::make() },
    Part { name: "command", make: |_| command_line::make() },
    Part { name: "npm", make: |_| javascript::make_package() },
    Part { name: "page", make: |_| javascript::make_page() },
    Part { name: "sdist", make: |extent| source_distribution::make(extent.is_full()) },
    Part { name: "wheel", make: |_| wheel::make() },
];

/// Makes the parts that `options` name, all without, and prints the table of the archives.
pub fn dry_run(options: &[&str]) -> Outcome {
    let (parts, extent) = chosen(options)?;
    check()?;
    if parts.len() == PARTS.len() {
        files::clear()?;
    }
    for part in parts {
        eprintln!("\n== release: {}", part.name);
        (part.make)(extent)?;
    }
    files::write_checksums()?;
    table::print()
}

/// Checks what needs no build: versions, what crates say of themselves, links that lead out of a package.
pub fn check() -> Outcome {
    let members = member::all()?;
    versions::check(&members)?;
    crates::check(&members)?;
    links::check(&members)
}

/// Refuses to publish what is not complete; `tag` is the name of the release in Git.
pub fn check_readiness(tag: &str) -> Outcome {
    check()?;
    let open = readiness::open_points(Some(tag))?;
    if open.is_empty() { Ok(()) } else { Err(format!("before a release:\n{}", open.join("\n"))) }
}

/// The parts and the extent that options name.
fn chosen(options: &[&str]) -> Outcome<(Vec<&'static Part>, Extent)> {
    let (mut parts, mut extent) = (Vec::new(), Extent::Usual);
    let mut options = options.iter();
    while let Some(option) = options.next() {
        match *option {
            "--full" => extent = Extent::Full,
            "--part" => parts.push(part(options.next().copied().unwrap_or_default())?),
            other => return Err(format!("release --dry-run does not know {other:?}")),
        }
    }
    if parts.is_empty() {
        parts = PARTS.iter().collect();
    }
    Ok((parts, extent))
}

/// The part of a name.
fn part(name: &str) -> Outcome<&'static Part> {
    PARTS.iter().find(|part| part.name == name).ok_or_else(|| {
        let names: Vec<&str> = PARTS.iter().map(|part| part.name).collect();
        format!("a release has no part {name:?}; its parts are {}", names.join(", "))
    })
}

#[cfg(test)]
mod tests {
    use super::{Extent, PARTS, chosen};

    #[test]
    fn options_name_parts_and_all_are_made_without() {
        let (parts, extent) = chosen(&["--part", "npm", "--full", "--part", "c"]).unwrap();
        assert_eq!(parts.iter().map(|part| part.name).collect::<Vec<_>>(), ["npm", "c"]);
        assert_eq!(extent, Extent::Full);
        assert_eq!(chosen(&[]).unwrap().0.len(), PARTS.len());
        for wrong in [&["--part"][..], &["--part", "wheels"], &["--dry"]] {
            assert!(chosen(wrong).is_err(), "{wrong:?}");
        }
    }
}
