//! The header matches the sources, and two programs in `examples` call each of its functions.
//!
//! `cargo xtask header` lets the first test rewrite the header.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use cbindgen::{Builder, Config};

/// The sources in the order of their declarations in the header.
const SOURCES: [&str; 22] = [
    "version",
    "status",
    "world",
    "scene",
    "step",
    "sphere",
    "quantity",
    "motion",
    "strike",
    "collider",
    "collider_motion",
    "mesh",
    "force",
    "spring",
    "emitter",
    "listing",
    "report",
    "accounts",
    "measures",
    "query",
    "path",
    "snapshot",
];
/// Sources without declarations in the header.
const OTHERS: [&str; 4] = ["described", "handle", "lib", "pointer"];

fn folder() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn header() -> String {
    let config = Config::from_file(folder().join("cbindgen.toml")).unwrap();
    let sources = SOURCES.map(|name| folder().join("src").join(name).with_extension("rs"));
    let builder = sources.into_iter().fold(Builder::new(), Builder::with_src);
    let mut text = Vec::new();
    builder.with_config(config).generate().unwrap().write(&mut text);
    String::from_utf8(text).unwrap()
}

#[test]
fn the_header_is_what_the_sources_declare() {
    let (file, made) = (folder().join("include/carom.h"), header());
    if std::env::var_os("CAROM_WRITE_HEADER").is_some() {
        fs::write(&file, &made).unwrap();
    }
    let kept = fs::read_to_string(&file).unwrap_or_default();
    assert!(kept == made, "include/carom.h is not up to date: run `cargo xtask header`");
}

#[test]
fn every_source_is_in_the_header_or_declares_nothing() {
    let files = fs::read_dir(folder().join("src")).unwrap();
    let found: BTreeSet<String> = files
        .map(|file| file.unwrap().path().file_stem().unwrap().to_str().unwrap().to_owned())
        .collect();
    let known: BTreeSet<String> = SOURCES.iter().chain(&OTHERS).map(|&it| it.to_owned()).collect();
    assert_eq!(found, known);
    for name in OTHERS {
        let text = fs::read_to_string(folder().join(format!("src/{name}.rs"))).unwrap();
        assert!(!text.contains("no_mangle"), "{name} declares functions");
    }
}

/// Returns the names of all functions in the header.
fn functions() -> BTreeSet<String> {
    let text = fs::read_to_string(folder().join("include/carom.h")).unwrap();
    let code: Vec<&str> = text.lines().filter(|line| !line.trim().starts_with("//")).collect();
    let names = code.iter().flat_map(|line| called(line));
    names.collect()
}

/// Returns the functions of the interface that a line of C declares or calls.
fn called(line: &str) -> Vec<String> {
    let starts = line.match_indices("carom_").map(|(start, _)| &line[start..]);
    let names = starts.filter_map(|rest| {
        let end = rest.find(|letter: char| !letter.is_alphanumeric() && letter != '_')?;
        rest[end..].starts_with('(').then(|| rest[..end].to_owned())
    });
    names.collect()
}

#[test]
fn a_program_calls_every_function_of_the_header() {
    let read = |name: &str| fs::read_to_string(folder().join("examples").join(name)).unwrap();
    let programs = ["every_function.c", "every_query.c"].map(read).concat();
    let code = programs.lines().filter(|line| !line.trim().starts_with("//"));
    let called: BTreeSet<String> = code.flat_map(called).collect();
    let declared = functions();
    assert!(declared.len() > 50, "{declared:?}");
    assert_eq!(declared.difference(&called).collect::<Vec<_>>(), Vec::<&String>::new());
}
