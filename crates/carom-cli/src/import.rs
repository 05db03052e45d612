//! The command `import`: converts scenes of Unity and glTF, and particle files, to scene files.

use std::collections::BTreeSet;
use std::io::{self, Write};
use std::path::Path;

use carom_gltf::Imported;
use carom_scene::Scene;
use carom_scene::import::Omission;
use carom_scene::recording::{
    ParticleError, ParticleFormat, ParticleImport, ParticleOptions, import_particles,
};
use carom_scene::scene::Rule;
use carom_scene::unfinished::create_folders_of;
use carom_unity::{ImportError, Mapping, Options, Project};

use crate::args::Import;
use crate::failure::{Failure, complain, unwritable};
use crate::replacing::Replacing;

/// Imports a scene, or every scene of Unity in a folder.
pub fn import(import: &Import) -> Result<(), Failure> {
    if let Some(format) = ParticleFormat::of(&import.path).filter(|_| import.path.is_file()) {
        return of_particles(import, format);
    }
    let particles_only =
        [("--radius", import.radius.is_some()), ("--frame", import.frame.is_some())];
    if let Some((option, _)) = particles_only.iter().find(|(_, is_given)| *is_given) {
        let message =
            format!("{option} is for particle files: .xyz, .extxyz, .lammpstrj, .dump, .gsd");
        return Err(Failure::Usage(message));
    }
    if is_gltf(&import.path) {
        let Imported { scene, omissions } = of_gltf(import)?;
        list(&import.path, &omissions);
        return one(import, &scene);
    }
    if import.path.is_file() && !ends_in(&import.path, "unity") {
        let text = "can be imported are scenes of Unity (.unity), glTF (.gltf, .glb) and particle files (.xyz, \
                    .extxyz, .lammpstrj, .dump, .gsd)";
        return Err(Failure::Usage(format!("{}: {text}", import.path.display())));
    }
    let options = options(import)?;
    let project = Project::around(&import.path).map_err(refused)?;
    if !import.path.is_dir() {
        return one(import, &of_unity(&import.path, &project, &options)?);
    }
    let folder = import.out.as_deref().unwrap_or(Path::new("."));
    std::fs::create_dir_all(folder).map_err(|error| unwritable(folder, &error))?;
    let scenes = project.scenes(&import.path).map_err(refused)?;
    let (mut failed, mut files) = (0, BTreeSet::new());
    for scene in &scenes {
        let file = folder.join(scene.with_extension("toml").file_name().unwrap_or_default());
        let written = if files.insert(file.clone()) {
            of_unity(scene, &project, &options)
                .and_then(|imported| write(&file, &imported, import.replacing))
        } else {
            let scene = scene.display();
            Err(Failure::Usage(format!("{scene}: another scene of the folder has this name")))
        };
        match written {
            Ok(()) => writeln!(io::stdout(), "wrote {}", file.display())?,
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

/// Writes the scene to the output file, or prints it if there is none.
fn one(import: &Import, scene: &Scene) -> Result<(), Failure> {
    match &import.out {
        Some(file) => {
            write(file, scene, import.replacing)?;
            Ok(writeln!(io::stdout(), "wrote {}", file.display())?)
        }
        None => Ok(io::stdout().lock().write_all(scene.to_toml().as_bytes())?),
    }
}

/// Whether the ending of the file is that of glTF.
fn is_gltf(path: &Path) -> bool {
    ends_in(path, "gltf") || ends_in(path, "glb")
}

fn ends_in(path: &Path, ending: &str) -> bool {
    path.extension().is_some_and(|it| it.eq_ignore_ascii_case(ending))
}

/// Refuses a mapping of scripts for a file that has none.
fn refuse_map(import: &Import, format: &str) -> Result<(), Failure> {
    match import.map {
        Some(_) => {
            let message = format!("--map is for scripts of Unity; {format} has none");
            Err(Failure::Usage(message))
        }
        None => Ok(()),
    }
}

/// Imports a frame of a particle file.
fn of_particles(import: &Import, format: ParticleFormat) -> Result<(), Failure> {
    refuse_map(import, "a particle file")?;
    let (frame_time, duration) = (import.frame_time, import.seconds);
    let (frame, radius) = (import.frame, import.radius);
    let options = ParticleOptions { frame, radius, rule: rule(import), frame_time, duration };
    let imported = import_particles(&import.path, format, &options);
    let ParticleImport { scene, omissions, .. } = imported.map_err(|error| match error {
        ParticleError::Unreadable { .. }
        | ParticleError::Radius { .. }
        | ParticleError::NoFrame { .. } => Failure::Usage(error.to_string()),
        _ => Failure::Fault(error.to_string()),
    })?;
    list(&import.path, &omissions);
    one(import, &scene)
}

fn of_gltf(import: &Import) -> Result<Imported, Failure> {
    refuse_map(import, "glTF")?;
    let (frame_time, duration) = (import.frame_time, import.seconds);
    let options = carom_gltf::Options { rule: rule(import), frame_time, duration };
    carom_gltf::import(&import.path, &options).map_err(|error| match error {
        carom_gltf::ImportError::Unreadable { .. } => Failure::Usage(error.to_string()),
        _ => Failure::Fault(error.to_string()),
    })
}

fn options(import: &Import) -> Result<Options, Failure> {
    let mapping = import.map.as_deref().map(Mapping::from_file).transpose().map_err(refused)?;
    let mapping = mapping.unwrap_or_else(Mapping::course);
    let (frame_time, duration) = (import.frame_time, import.seconds);
    Ok(Options { mapping, rule: rule(import), frame_time, duration })
}

fn rule(import: &Import) -> Option<Rule> {
    let rules = [Rule::Exact, Rule::Contact, Rule::Bisect, Rule::Discrete];
    rules.into_iter().find(|rule| import.rule.as_deref() == Some(rule.name()))
}

/// Imports a scene of Unity, and prints omissions on the standard error stream.
fn of_unity(scene: &Path, project: &Project, options: &Options) -> Result<Scene, Failure> {
    let imported = carom_unity::import(scene, project, options).map_err(refused)?;
    list(scene, &imported.omissions);
    Ok(imported.scene)
}

/// Prints the omissions of an import on the standard error stream.
fn list(path: &Path, omissions: &[Omission]) {
    for omission in omissions {
        complain(&format!("{}: {omission}", path.display()));
    }
}

fn write(file: &Path, scene: &Scene, replacing: Replacing) -> Result<(), Failure> {
    replacing.check([file])?;
    let written = create_folders_of(file).and_then(|()| std::fs::write(file, scene.to_toml()));
    written.map_err(|error| unwritable(file, &error))
}

fn refused(error: ImportError) -> Failure {
    match error {
        ImportError::Unreadable { .. } => Failure::Usage(error.to_string()),
        _ => Failure::Fault(error.to_string()),
    }
}
