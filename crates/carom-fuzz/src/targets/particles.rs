//! Particle files of runs with a few things wrong.

use std::fs;

use carom_scene::Library;
use carom_scene::recording::{
    ParticleFormat, ParticleOptions, Trajectory, import_particles, recover_particles,
};
use proptest::prelude::*;

use crate::case::text;
use crate::fault::{Fault, check_error};
use crate::mutation::mutated;
use crate::target::{Answer, Target};

pub const TARGET: Target = Target {
    name: "particles",
    about: "particle files of runs with a few things wrong",
    campaign: 5_000,
    cases: || mutated(files()).boxed(),
    check,
};

/// First bytes of GSD files.
const GSD: &[u8] = &0x65DF_65DF_65DF_65DF_u64.to_le_bytes();

/// Files of runs with balls that turn and that do not, in all formats, and one with a periodic box.
fn files() -> Vec<Vec<u8>> {
    let scenes = [("simtest4", 3), ("billiards", 2)];
    let files = scenes.iter().flat_map(|(name, frames)| {
        ["xyz", "lammpstrj", "gsd"].map(|ending| file(name, *frames, ending))
    });
    let periodic = "2\nLattice=\"2 0 0 0 2 0 0 0 2\" pbc=\"T F T\" \
                    Properties=species:S:1:id:I:1:pos:R:3:radius:R:1\nX 1 0 0 0 0.2\nX 0 1 1 1 0.3\n";
    files.flatten().chain([periodic.as_bytes().to_vec()]).collect()
}

fn file(name: &str, frames: usize, ending: &str) -> Option<Vec<u8>> {
    let (scene, _) = Library::new().find(name, &[]).ok()?;
    let folder = tempfile::tempdir().ok()?;
    let path = folder.path().join("run").with_extension(ending);
    let mut world = scene.world().ok()?;
    let mut trajectory = Trajectory::create(&path).ok()?;
    for _ in 0..frames {
        world.step(scene.simulation.frame_time).ok()?;
        trajectory.write(&world).ok()?;
    }
    trajectory.finish().ok()?;
    fs::read(&path).ok()
}

fn check(case: &[u8]) -> Result<Answer, Fault> {
    let failed = |it: &dyn std::fmt::Display| Fault::Law(format!("cannot be tried: {it}"));
    let folder = tempfile::tempdir().map_err(|it| failed(&it))?;
    let text = text(case);
    let (name, content) = match case {
        _ if case.starts_with(GSD) => ("case.gsd", case),
        _ if text.contains("ITEM:") => ("case.dump", text.as_bytes()),
        _ => ("case.xyz", text.as_bytes()),
    };
    let path = folder.path().join(name);
    fs::write(&path, content).map_err(|it| failed(&it))?;
    let format = ParticleFormat::of(&path).ok_or_else(|| failed(&"no format"))?;
    let options = ParticleOptions::default();
    match import_particles(&path, format, &options) {
        Ok(imported) => {
            imported.scene.world().map_err(|it| Fault::Law(format!("an invalid scene: {it}")))?;
            // What is left after a kill is read as before.
            if recover_particles(&path, format).is_ok() {
                let again = import_particles(&path, format, &options);
                let again = again.map_err(|it| Fault::Law(format!("recovered: {it}")))?;
                if again.scene.spheres != imported.scene.spheres {
                    return Err(Fault::Law("recovering changes the last frame".to_owned()));
                }
            }
            Ok(Answer::Accepted)
        }
        Err(error) => {
            check_error(&error.to_string())?;
            Ok(Answer::Refused)
        }
    }
}
