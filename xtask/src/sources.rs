//! Reads and parses the sources of the workspace.

use std::fs;
use std::path::{Path, PathBuf};

use syn::{Attribute, Item, Meta};

use crate::shell::{Outcome, root};

/// A module with its own file.
pub struct Source {
    /// Path of the module from the root of its crate; empty for the root.
    pub module: Vec<String>,
    /// Path of the file from the root of the repository.
    pub file: PathBuf,
    pub syntax: syn::File,
}

/// Returns the source folders of all crates.
pub fn folders() -> Outcome<Vec<PathBuf>> {
    let crates = root().join("crates");
    let entries = fs::read_dir(&crates).map_err(|error| said(&crates, &error))?;
    let mut folders: Vec<PathBuf> =
        entries.filter_map(|entry| Some(entry.ok()?.path().join("src"))).collect();
    folders.retain(|folder| folder.is_dir());
    folders.push(root().join("xtask/src"));
    folders.sort();
    Ok(folders)
}

/// Returns the crates in a folder, a library and a program: the modules of each, without tests.
pub fn crates_of(folder: &Path) -> Outcome<Vec<Vec<Source>>> {
    let roots = ["lib.rs", "main.rs"].map(|name| folder.join(name));
    roots.iter().filter(|file| file.exists()).map(|file| modules_from(file)).collect()
}

/// Returns every Rust file in a folder and its subfolders.
pub fn files_of(folder: &Path) -> Outcome<Vec<PathBuf>> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).map_err(|error| said(folder, &error))? {
        let path = entry.map_err(|error| said(folder, &error))?.path();
        if path.is_dir() {
            files.extend(files_of(&path)?);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
    files.sort();
    Ok(files)
}

/// Reads a file.
pub fn read(file: &Path) -> Outcome<String> {
    fs::read_to_string(file).map_err(|error| said(file, &error))
}

/// Reads and parses a file.
pub fn parse(file: &Path) -> Outcome<syn::File> {
    syn::parse_file(&read(file)?).map_err(|error| {
        let at = error.span().start();
        format!("{}:{}: {error}", seen_from_root(file).display(), at.line)
    })
}

/// Returns the path of a file from the root of the repository.
pub fn seen_from_root(file: &Path) -> &Path {
    file.strip_prefix(root()).unwrap_or(file)
}

/// Returns whether an item with these attributes is only for tests.
pub fn is_for_tests(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| match &attribute.meta {
        Meta::Path(path) => path.is_ident("test"),
        Meta::List(list) => {
            list.path.is_ident("cfg") && list.tokens.to_string().replace(' ', "") == "test"
        }
        Meta::NameValue(_) => false,
    })
}

/// Returns the module in a file and all modules that it declares, without tests.
fn modules_from(file: &Path) -> Outcome<Vec<Source>> {
    let mut sources = Vec::new();
    let mut ahead = vec![(Vec::new(), file.to_owned())];
    while let Some((module, file)) = ahead.pop() {
        let syntax = parse(&file)?;
        for item in &syntax.items {
            if let Item::Mod(child) = item
                && child.content.is_none()
                && !is_for_tests(&child.attrs)
            {
                let mut path: Vec<String> = module.clone();
                path.push(child.ident.to_string());
                let file = file_of(&file, &path)?;
                ahead.push((path, file));
            }
        }
        let file = seen_from_root(&file).to_owned();
        sources.push(Source { module, file, syntax });
    }
    Ok(sources)
}

/// Returns the file of a module that the file of its parent declares.
fn file_of(parent: &Path, module: &[String]) -> Outcome<PathBuf> {
    let name = module.last().map_or("", String::as_str);
    let stem = parent.file_stem().unwrap_or_default();
    let beside = parent.parent().unwrap_or(parent);
    let is_folder = ["lib", "main", "mod"].iter().any(|it| stem == *it);
    let folder = if is_folder { beside.to_owned() } else { beside.join(stem) };
    let places = [folder.join(format!("{name}.rs")), folder.join(name).join("mod.rs")];
    let found = places.into_iter().find(|place| place.exists());
    found.ok_or_else(|| format!("{}: no file of module {name}", parent.display()))
}

fn said(path: &Path, error: &std::io::Error) -> String {
    format!("{}: {error}", path.display())
}
