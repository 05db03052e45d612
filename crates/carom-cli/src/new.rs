//! The command `new`: writes a scene file to start from.

use std::fs::OpenOptions;
use std::io::{self, ErrorKind, Write};
use std::path::Path;

use carom_scene::unfinished::create_folders_of;

use crate::args::New;
use crate::failure::{Failure, unwritable};
use crate::replacing::already_there;

/// Text of the scene; its name is `NAME`.
const TEMPLATE: &str = include_str!("new.toml");

/// Writes a scene file to start from.
pub fn new(new: &New) -> Result<(), Failure> {
    let file = if new.name.extension().is_some_and(|it| it == "toml") {
        new.name.clone()
    } else {
        let mut name = new.name.clone().into_os_string();
        name.push(".toml");
        name.into()
    };
    let name = file.file_stem().unwrap_or_default().to_string_lossy();
    // A name may contain quotation marks.
    let name = toml_text(&name);
    write(&file, &TEMPLATE.replace("\"NAME\"", &name), new.replacing.force)?;
    let mut out = io::stdout().lock();
    writeln!(out, "wrote {file}: change it, and run it with", file = file.display())?;
    writeln!(out, "    carom view {}", file.display())?;
    Ok(())
}

/// Quotes a text for TOML.
fn toml_text(text: &str) -> String {
    // Strings of JSON are valid in TOML.
    serde_json::Value::from(text).to_string()
}

fn write(file: &Path, content: &str, replaces: bool) -> Result<(), Failure> {
    let mut options = OpenOptions::new();
    options.write(true);
    if replaces {
        options.create(true).truncate(true);
    } else {
        options.create_new(true);
    }
    let opened = create_folders_of(file).and_then(|()| options.open(file));
    let mut writing = opened.map_err(|error| match error.kind() {
        ErrorKind::AlreadyExists => already_there(file),
        _ => unwritable(file, &error),
    })?;
    let written = writing.write_all(content.as_bytes());
    written.map_err(|error| unwritable(file, &error))
}
