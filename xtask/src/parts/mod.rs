//! The classes of Python that scenes are made of, from the schema of scene files.
//!
//! Fields, types, ranges, defaults and documentation come from the schema. `layout.json` has what it
//! does not say: what classes are called, in which order arguments stand, what Python says
//! differently, which fields are checked together. A field that is new in the schema needs no word
//! there: it comes after the others.

mod alias;
mod doc;
mod field;
mod layout;
mod module;
mod schema;

use std::fs;
use std::path::PathBuf;

use serde_json::Value;

use crate::files::said;
use crate::shell::{Outcome, root};
use crate::sources::read;

const SCHEMA: &str = "crates/carom-scene/scenes/scene.schema.json";
const FOLDER: &str = "python/carom/_scene/parts";
/// What Python says besides the schema.
const LAYOUT: &str = include_str!("layout.json");
/// Modules of the folder that are written by hand and used by those that are made.
const BY_HAND: [&str; 3] = ["kinds", "part", "together"];

/// Writes the classes.
pub fn write() -> Outcome {
    for (file, text) in made()? {
        fs::write(&file, text).map_err(|error| said(&file, &error))?;
    }
    Ok(())
}

/// Refuses classes that are not what the schema makes.
pub fn check() -> Outcome {
    for (file, text) in made()? {
        if read(&file)? != text {
            let file = file.display();
            return Err(format!("{file}: run `cargo xtask parts` and commit the result"));
        }
    }
    Ok(())
}

/// The files with their texts.
fn made() -> Outcome<Vec<(PathBuf, String)>> {
    let parsed = |text: &str| serde_json::from_str::<Value>(text).map_err(|it| it.to_string());
    let schema = schema::Schema::new(parsed(&read(&root().join(SCHEMA))?)?);
    let layout = parsed(LAYOUT)?;
    let folder = root().join(FOLDER);
    let mut names = module::Names::new(&layout);
    for module in BY_HAND {
        names.add_python(module, &read(&folder.join(format!("{module}.py")))?);
    }
    let modules = layout["modules"].as_array().into_iter().flatten();
    let file = |module: &Value| {
        let name = module["file"].as_str().unwrap_or_default();
        Ok((folder.join(format!("{name}.py")), module::text(module, &schema, &names)?))
    };
    modules.map(file).collect()
}
