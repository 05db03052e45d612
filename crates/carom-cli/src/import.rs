//! Scenes of Unity to scene files.

use std::collections::BTreeSet;
use std::io::{self, Write};
use std::path::Path;

use carom_scene::scene::Rule;
use carom_unity::{ImportError, Imported, Mapping, Options, Project};

use crate::args::Import;
use crate::failure::{Failure, complain};
use crate::replacing::Replacing;

/// Imports a scene, or every scene in a folder.
pub fn import(import: &Import) -> Result<(), Failure> {
    let options = options(import)?;
    let project = Project::around(&import.path).map_err(refused)?;
    if !import.path.is_dir() {
        let imported = one(&import.path, &project, &options)?;
        return match &import.out {
            Some(file) => {
                write(file, &imported, import.replacing)?;
                Ok(writeln!(io::stdout(), "{} is there", file.display())?)
            }
            None => Ok(io::stdout().lock().write_all(imported.scene.to_toml().as_bytes())?),
        };
    }
    let folder = import.out.as_deref().unwrap_or(Path::new("."));
    std::fs::create_dir_all(folder).map_err(|error| unwritable(folder, &error))?;
    let scenes = project.scenes(&import.path).map_err(refused)?;
    let (mut failed, mut files) = (0, BTreeSet::new());
    for scene in &scenes {
        let file = folder.join(scene.with_extension("toml").file_name().unwrap_or_default());
        let written = if files.insert(file.clone()) {
            one(scene, &project, &options)
                .and_then(|imported| write(&file, &imported, import.replacing))
        } else {
            let scene = scene.display();
            Err(Failure::Usage(format!("{scene}: another scene of the folder has this name")))
        };
        match written {
            Ok(()) => writeln!(io::stdout(), "{} is there", file.display())?,
            Err(Failure::Fault(message) | Failure::Usage(message)) => {
                failed += 1;
                complain(&message);
            }
            Err(failure) => return Err(failure),
        }
    }
    match failed {
        0 => Ok(()),
        _ => Err(Failure::Fault(format!("{failed} of {} scenes are not imported", scenes.len()))),
    }
}

fn options(import: &Import) -> Result<Options, Failure> {
    let mapping = import.map.as_deref().map(Mapping::from_file).transpose().map_err(refused)?;
    let rule = import.rule.as_deref().and_then(|name| {
        let rules = [Rule::Exact, Rule::Contact, Rule::Bisect, Rule::Discrete];
        rules.into_iter().find(|rule| rule.name() == name)
    });
    let mapping = mapping.unwrap_or_else(Mapping::course);
    Ok(Options { mapping, rule, frame_time: import.frame_time, duration: import.seconds })
}

/// Imports a scene, and lists on the standard error stream what it leaves out.
fn one(scene: &Path, project: &Project, options: &Options) -> Result<Imported, Failure> {
    let imported = carom_unity::import(scene, project, options).map_err(refused)?;
    for omission in &imported.omissions {
        complain(&format!("{}: {omission}", scene.display()));
    }
    Ok(imported)
}

fn write(file: &Path, imported: &Imported, replacing: Replacing) -> Result<(), Failure> {
    replacing.check([file])?;
    std::fs::write(file, imported.scene.to_toml()).map_err(|error| unwritable(file, &error))
}

fn unwritable(path: &Path, error: &io::Error) -> Failure {
    Failure::Fault(format!("cannot write {}: {error}", path.display()))
}

fn refused(error: ImportError) -> Failure {
    match error {
        ImportError::Unreadable { .. } => Failure::Usage(error.to_string()),
        _ => Failure::Fault(error.to_string()),
    }
}
